// report.c: reporting of run-time errors; see machine.h.
//
// The table of reported errors is at most half full, so a search is short. After that, the frame reports no further
// errors.
#include "vm/machine.h"

#include <stdarg.h>

// Returns true if an error must be reported, and records the error. Returns false if the same error was already
// reported at this position in this frame, or if too many errors were reported. If execution is speculative, does not
// record the error, sets speculation_failed and returns false.
static bool is_new_error(Vm *vm, const Origin *at, uint64_t what) {
    if (vm->reported_count >= VM_REPORTED / 2)
        return false;
    uint32_t i = (uint32_t)hash_mix((uint64_t)(uintptr_t)at ^ what << 1) % VM_REPORTED;
    for (; vm->reported[i].at; i = (i + 1) % VM_REPORTED)
        if (vm->reported[i].at == at && vm->reported[i].what == what)
            return false;
    if (vm->speculative) {
        vm->speculation_failed = true;
        return false;
    }
    vm->reported[i] = (Reported){at, what};
    vm->reported_count++;
    return true;
}

static void report_vm_diagnostic(Vm *vm, const Origin *at, DiagLevel level, const char *code, Str text) {
    Diag diag = {level, *at, text, .code = code};
    vm->host.report(vm->host.user_data, &diag);
}

void vm_report_text(Vm *vm, const Origin *at, const char *code, Str text) {
    if (is_new_error(vm, at, hash_bytes(0, text.bytes, text.len)))
        report_vm_diagnostic(vm, at, DIAG_WARNING, code, text);
}

void vm_report(Vm *vm, const Origin *at, const char *code, const char *format, ...) {
    if (!is_new_error(vm, at, (uint64_t)(uintptr_t)format))
        return;
    va_list args;
    va_start(args, format);
    Text text = text_new(vm->arena);
    text_add_va(&text, format, args);
    va_end(args);
    report_vm_diagnostic(vm, at, DIAG_WARNING, code, text_str(&text));
}

Value vm_finish(Vm *vm, const Origin *at, Vector *vector) {
    if (vector->overflow)
        vm_report(vm, at, "too-long", "vector too long: the limit is 134217728 elements");
    return vector_finish(vector);
}
