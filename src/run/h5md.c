// h5md.c: see h5md.h. Columns are sent to petri-hdf5 directly from the session's memory, without a copy.
#include "run/h5md.h"

#include "run/frames.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

bool h5md_open(H5md *file, const char *path, const Resume *resume, Output *output) {
    char after[64] = "";
    *file = (H5md){0};
    if (resume)
        snprintf(after, sizeof after, "%" PRId64 " %" PRId64, resume->after, resume->expected);
    bool started = hdf5_start(&file->writer, "trajectory", path, resume ? after : NULL, frames_signal);
    output_start(output, file->writer.stream);
    output->send = hdf5_write;
    output->user_data = &file->writer;
    return started;
}

static void send_text(Output *output, const char *text, size_t length) {
    static const char filling[8];
    output_write(output, text, length);
    output_write(output, filling, hdf5_padded(length) - length);
}

static void send_column(Output *output, PetriColumn column, size_t width, uint32_t count) {
    if (column.stride == width && count > 0) {
        output_write(output, (const char *)column.data, count * width * sizeof(double));
        return;
    }
    for (uint32_t i = 0; i < count; i++)
        output_write(output, (const char *)(column.data + i * column.stride), width * sizeof(double));
}

static void send_system(Output *output, const PetriSystem *system, const int64_t *ids,
                        const ParticlesEnergies *energies) {
    Hdf5System head = {system->particle_count, system->dimensions, hdf5_padded(strlen(system->name)),
                       energies ? energies->kinetic : NAN, energies ? energies->potential : NAN};
    output_write(output, (const char *)&head, sizeof head);
    send_text(output, system->name, strlen(system->name));
    send_column(output, system->position, system->dimensions, system->particle_count);
    send_column(output, system->velocity, system->dimensions, system->particle_count);
    send_column(output, system->radius, 1, system->particle_count);
    send_column(output, system->mass, 1, system->particle_count);
    send_column(output, system->charge, 1, system->particle_count);
    output_write(output, (const char *)ids, system->particle_count * sizeof *ids);
    for (uint32_t i = 0; i < system->particle_count; i++) {
        int64_t is_anchor = system->anchor[i * system->anchor_stride];
        output_write(output, (const char *)&is_anchor, sizeof is_anchor);
    }
}

static void send_head(Output *output, Hdf5Command act, uint64_t bytes) {
    Hdf5Head head = {act, bytes};
    output_write(output, (const char *)&head, sizeof head);
}

bool h5md_add(H5md *file, PetriSession *session, const ParticlesEnergies *energies, Output *output) {
    SCOPED_TEXT texts = {0};
    PetriFrame now;
    petri_frame(session, &now, sizeof now);
    Hdf5Frame frame = {.number = now.number, .time = now.time, .text_count = file->sent};
    uint64_t bytes = sizeof frame;
    PetriSystem system;
    file->ids.len = 0;
    text_add_c(&file->ids, "");
    text_add_c(&texts, "");
    for (size_t s = 0; petri_system(session, s, &system, sizeof system); frame.system_count = ++s) {
        if (!id_numbers_of_system(&file->names, session, s, &system, &file->ids))
            return false;
        bytes += sizeof(Hdf5System) + hdf5_padded(strlen(system.name)) +
                 system.particle_count * (2 * system.dimensions + HDF5_NUMBERS) * sizeof(double);
    }
    for (; file->sent < file->names.texts.count; file->sent++)
        text_add(&texts, (Str){file->names.texts.items[file->sent], strlen(file->names.texts.items[file->sent]) + 1});
    frame.text_count = file->sent - frame.text_count;
    frame.text_bytes = hdf5_padded(texts.len);
    send_head(output, HDF5_ADD, bytes + frame.text_bytes);
    output_write(output, (const char *)&frame, sizeof frame);
    send_text(output, texts.bytes, texts.len);
    const int64_t *ids = (const int64_t *)(const void *)file->ids.bytes;
    for (size_t s = 0; petri_system(session, s, &system, sizeof system); s++) {
        send_system(output, &system, ids, energies ? &energies[s] : NULL);
        ids += system.particle_count;
    }
    output_flush(output); // so that petri-hdf5 has all complete frames if this process is killed
    return true;
}

bool h5md_sync(H5md *file, Output *output) {
    send_head(output, HDF5_SYNC, 0);
    return output_flush(output) && hdf5_wait(&file->writer);
}

bool h5md_close(H5md *file, bool keep, Output *output) {
    send_head(output, keep ? HDF5_COMMIT : HDF5_DISCARD, 0);
    bool sent = output_flush(output);
    id_numbers_free(&file->names);
    text_free(&file->ids);
    return hdf5_end(&file->writer) && sent;
}
