// fuzz_files.c: fuzzes reading of files. The input is a file that a script reads. The first byte of the input selects
// the script.
#include "fuzz.h"
#include "petri-inspect.h"

FUZZ_HARNESS(files) {
    static const char *const scripts[] = {
        "!a x=csv('data',frame) y=csv('data',3) z=csv('data',1e9)\n",
        "!a x=srt('data',frame) y=srt('data',3.5) z=srt('data',0/0)\n",
        "!a x=read('data') y=len(split(read('data'))) z=ord(read('data'))\n",
        "!a x=read_bytes('data')\n    for i in ..3\n        !b c=csv('data',i) d=csv('data',-i)\n",
        "import x from 'data'\n!a x=x\n",
        "%include 'data'\n!a\n",
    };
    if (size == 0)
        return 0;
    fuzz_put("data", data + 1, size - 1);
    PetriSession *session = fuzz_open(NULL);
    const char *script = scripts[data[0] % (sizeof scripts / sizeof scripts[0])];
    if (petri_load_text(session, fuzz_file("fuzz.fl"), script, PETRI_NUL_TERMINATED) == PETRI_OK)
        for (int i = 0; i < 3 && petri_step(session) == PETRI_OK; i++)
            petri_print(session, PETRI_PRINT_TREE | PETRI_PRINT_STATE, fuzz_sink, NULL);
    fuzz_close(&session);
    return 0;
}
