// trajectory.c: the file of `petri run --trajectory`; see trajectory.h.
//
// For extended XYZ, see xyz.h; for CSV, see cli/particles.h; for H5MD, see h5md.h.
#include "run/trajectory.h"

#include "base/file.h"
#include "cli/cli.h"
#include "cli/memory.h"
#include "cli/motion.h"
#include "cli/particles.h"
#include "cli/script.h"
#include "cli/signal_cleanup.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool report_error(Trajectory *trajectory, int error) {
    // These errors mean that petri-hdf5 has reported its own error and exited. The error is ECONNRESET if petri-hdf5
    // had not read all data before it exited.
    bool reported = trajectory->format == TRAJECTORY_H5MD && (error == EPIPE || error == ECONNRESET);
    if (!trajectory->failed && !reported)
        message("cannot write %s: %s", trajectory->path, strerror(error));
    trajectory->failed = true;
    return false;
}

// Saves the complete frames before a signal ends the process. This is a SignalCleanup, so it can run at any point of
// the program.
static void commit_on_signal(void *context) {
    Trajectory *trajectory = context;
    Output *output = &trajectory->output;
    int fd = output->fd;
    bool begun = trajectory->file.file >= 0 && !trajectory->file.direct && trajectory->complete_bytes > 0;
    if ((!begun && !trajectory->named) || trajectory->failed)
        return;
    // Part of the buffer may already be in the file, so the whole buffer is written again.
    if (output->error == 0 && lseek(fd, (off_t)output->written, SEEK_SET) >= 0 &&
        file_write(fd, output->buffer, output->used) && file_truncate(fd, trajectory->complete_bytes) &&
        !trajectory->named)
        replace_commit(&trajectory->file);
}

static TrajectoryFormat format_of(const char *path) {
    int format = script_suffix(path, ".xyz .csv"); // in the order of TrajectoryFormat
    return format < 0 ? TRAJECTORY_H5MD : (TrajectoryFormat)format;
}

static void write_named(Trajectory *trajectory, int fd, size_t end) {
    trajectory->named = true;
    trajectory->output.fd = fd;
    trajectory->output.written = trajectory->complete_bytes = trajectory->flushed_bytes = end;
}

// Continues an existing XYZ or CSV file. Returns false after a message.
static bool resume_file(Trajectory *trajectory, const Resume *resume) {
    ResumeFile file;
    XyzNames *names = trajectory->format == TRAJECTORY_CSV ? NULL : &trajectory->names;
    if (!resume_open(&file, trajectory->path, names, resume->after)) {
        xyz_free(&trajectory->names);
        return false;
    }
    if (file.fd >= 0) {
        trajectory->dimensions = file.dimensions;
        if (file.dimensions > 0)
            trajectory->energies = file.energies;
        write_named(trajectory, file.fd, file.end);
        resume_report_gap(trajectory->path, file.last, resume);
    }
    return true;
}

static bool is_regular_file(const char *path) {
    struct stat info;
    return stat(path, &info) != 0 || S_ISREG(info.st_mode);
}

bool trajectory_open(Trajectory *trajectory, const char *path, bool energies, const Resume *resume) {
    trajectory->energies = energies;
    trajectory->path = path;
    trajectory->format = format_of(path);
    trajectory->resumable = resume->wanted && is_regular_file(path);
    if (trajectory->format == TRAJECTORY_H5MD) {
        trajectory->open =
            h5md_open(&trajectory->h5md, path, trajectory->resumable ? resume : NULL, &trajectory->output);
        return trajectory->open;
    }
    output_start(&trajectory->output, -1);
    if (trajectory->resumable && resume->after >= 0 && !resume_file(trajectory, resume))
        return false;
    trajectory->open = trajectory->named || replace_begin(&trajectory->file, path, 0);
    if (!trajectory->open)
        return report_error(trajectory, errno);
    trajectory->output.fd = trajectory->named ? trajectory->output.fd : trajectory->file.file;
    trajectory->cleanup_id = signal_cleanup_begin(commit_on_signal, trajectory);
    return true;
}

static bool add_csv(Trajectory *trajectory, PetriSession *session, const ParticlesEnergies *energies) {
    if (trajectory->dimensions == 0) {
        trajectory->dimensions = particles_dimensions(session);
        particles_header(trajectory->dimensions, trajectory->energies, output_write, &trajectory->output);
    }
    return particles_rows(session, trajectory->dimensions, energies, output_write, &trajectory->output);
}

// Returns the energies of all systems, which the caller frees. Returns NULL if the file has no energies.
static ParticlesEnergies *measure_energies(const Trajectory *trajectory, PetriSession *session) {
    ParticlesEnergies *energies = NULL;
    PetriSystem system;
    for (size_t s = 0; trajectory->energies && petri_system(session, s, &system, sizeof system); s++) {
        energies = memory_realloc(energies, (s + 1) * sizeof *energies);
        motion_energies(session, s, &system, &energies[s].kinetic, &energies[s].potential);
    }
    return energies;
}

static bool add_frame(Trajectory *trajectory, PetriSession *session, const ParticlesEnergies *energies) {
    switch (trajectory->format) {
    case TRAJECTORY_XYZ:
        return xyz_add(&trajectory->names, session, energies, &trajectory->output);
    case TRAJECTORY_CSV:
        return add_csv(trajectory, session, energies);
    default:
        return h5md_add(&trajectory->h5md, session, energies, &trajectory->output);
    }
}

void trajectory_add(Trajectory *trajectory, PetriSession *session) {
    uint64_t errors = petri_diagnostic_count(session, PETRI_ERROR);
    ParticlesEnergies *energies = measure_energies(trajectory, session);
    bool whole = add_frame(trajectory, session, energies);
    free(energies);
    if (!whole || petri_diagnostic_count(session, PETRI_ERROR) != errors) { // part of the frame is missing
        report_error(trajectory, ENOMEM);
        return;
    }
    atomic_signal_fence(memory_order_seq_cst); // commit_on_signal may run at any moment
    trajectory->complete_bytes = trajectory->output.written + trajectory->output.used;
    if (trajectory->output.error != 0)
        report_error(trajectory, trajectory->output.error);
}

// Renames the file to its final name and continues writing to it.
static bool commit_name(Trajectory *trajectory) {
    int fd = fcntl(trajectory->file.file, F_DUPFD_CLOEXEC, 0);
    signal_cleanup_end(trajectory->cleanup_id);
    bool good = fd >= 0 && replace_commit(&trajectory->file);
    if (!good)
        report_error(trajectory, errno);
    if (fd >= 0)
        write_named(trajectory, fd, trajectory->complete_bytes);
    trajectory->cleanup_id = signal_cleanup_begin(commit_on_signal, trajectory);
    return good;
}

bool trajectory_sync(void *context) {
    Trajectory *trajectory = context;
    if (!trajectory->open || !trajectory->resumable)
        return true;
    if (trajectory->failed)
        return false;
    if (trajectory->format == TRAJECTORY_H5MD) {
        trajectory->failed = !h5md_sync(&trajectory->h5md, &trajectory->output);
        return !trajectory->failed;
    }
    if (!output_flush(&trajectory->output))
        return report_error(trajectory, trajectory->output.error);
    trajectory->flushed_bytes = trajectory->complete_bytes;
    if (!trajectory->named)
        return commit_name(trajectory);
    return replace_sync(trajectory->output.fd) || report_error(trajectory, errno);
}

// Removes an incomplete frame from the end of a file that is extended in place, then closes the file.
static bool end_named(Trajectory *trajectory, bool flushed) {
    int fd = trajectory->output.fd;
    bool good = file_truncate(fd, flushed ? trajectory->complete_bytes : trajectory->flushed_bytes) && replace_sync(fd);
    int cause = errno;
    close(fd);
    return flushed && (good || report_error(trajectory, cause));
}

static bool finish_file(Trajectory *trajectory, bool keep) {
    if (trajectory->format == TRAJECTORY_H5MD) {
        bool closed = h5md_close(&trajectory->h5md, keep, &trajectory->output);
        if (!closed && trajectory->output.error != 0)
            report_error(trajectory, trajectory->output.error);
        return closed;
    }
    bool flushed = output_flush(&trajectory->output) || report_error(trajectory, trajectory->output.error);
    signal_cleanup_end(trajectory->cleanup_id);
    if (trajectory->named)
        return end_named(trajectory, flushed);
    if (!flushed || !keep) {
        replace_abort(&trajectory->file);
        return flushed;
    }
    return replace_commit(&trajectory->file) || report_error(trajectory, errno);
}

bool trajectory_close(Trajectory *trajectory, bool good) {
    if (!trajectory->open)
        return true;
    trajectory->open = false;
    bool keep = !trajectory->failed && (good || trajectory->resumable || trajectory->complete_bytes > 0);
    xyz_free(&trajectory->names);
    return finish_file(trajectory, keep) && !trajectory->failed;
}
