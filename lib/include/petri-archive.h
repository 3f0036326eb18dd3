// petri-archive.h: archives of runs. An archive is a file from which anyone can replay, continue and verify a run.
//
// An archive is an SQLite database with everything that determines a run: files, parameters, inputs, and complete
// states (keyframes) from time to time. It also has a digest of each frame, so that a replay can be compared with the
// original run. src/archive/README.md describes its tables. The rules of petri.h apply.
//
// Archives need SQLite. In a build without it, petri_archive_problem returns this reason for each archive.
#ifndef PETRI_ARCHIVE_H
#define PETRI_ARCHIVE_H

#include "petri.h"

#ifdef __cplusplus
extern "C" {
#endif

// An archive that is written or read. Created by petri_archive_create or petri_archive_open, freed by
// petri_archive_close. Only one thread at a time may use an archive together with its session.
typedef struct PetriArchive PetriArchive;

// Options of a new archive. Start with petri_archive_default_options.
typedef struct PetriArchiveOptions {
    size_t size;            // sizeof(PetriArchiveOptions)
    int64_t keyframe_every; // number of frames from one keyframe to the next. Default 1000
    int64_t digest_every;   // number of frames from one digest to the next. Default 1
    const char *command;    // command line that created the archive; NULL (the default): not stored
} PetriArchiveOptions;

// Writes the default options to the first `size` bytes of `options`. Use petri_archive_default_options instead.
PETRI_API void petri_archive_options_init(PetriArchiveOptions *options, size_t size);

// Returns the default options.
static inline PetriArchiveOptions petri_archive_default_options(void) {
    PetriArchiveOptions options;
    petri_archive_options_init(&options, sizeof options);
    return options;
}

// Creates an archive and records the session in it from the next frame on. If a script is loaded, reads its files again
// and compiles it. If the session is already recorded in another archive, completes that one; if it is a replay, ends
// the replay. Check petri_archive_problem after the call, and when you want to know if recording has stopped, for
// example because the disk is full. The session is not affected by such problems. Returns NULL if out of memory. Free
// it with petri_archive_close, before or after the session. Host functions (petri_add_function), forces
// (petri_set_force_callback) and variations (petri_vary) cannot be recorded.
//
// `file` must be the name of a new file or of an archive, which is replaced. Any other file has a problem as its
// result, and so has an archive that another process or session is recording.
PETRI_API PetriArchive *petri_archive_create(PetriSession *session, const char *file,
                                             const PetriArchiveOptions *options);

// Returns true if a file starts like an archive. Only regular files are opened. Needs no SQLite.
PETRI_API bool petri_archive_is(const char *file);

// Opens an archive to read it. Its files and texts may take `memory_limit` bytes of memory; 0: 2 GiB. Writes and locks
// no file, and applies the journal of a killed recording in memory. If another process writes the archive later, it can
// no longer be read. Check petri_archive_problem after the call. Returns NULL if out of memory. Free it with
// petri_archive_close.
PETRI_API PetriArchive *petri_archive_open(const char *file, size_t memory_limit);

// Completes an archive that is written, and ends its recording. Returns PETRI_INVALID, with petri_archive_problem, if
// the archive does not have all frames. petri_archive_close also completes an archive, but does not report problems.
PETRI_API PetriStatus petri_archive_complete(PetriArchive *archive);

// Closes an archive and sets the handle to NULL. NULL handles are ignored. A written archive is completed. If the
// archive is replayed by a session, ends the replay: the session must not use its files (petri_archive_read) any more.
PETRI_API void petri_archive_close(PetriArchive **archive);

// Returns the first problem of an archive, or NULL if there is none: why it cannot be read or written any more, or
// which table and row is damaged. Valid until the archive is closed.
PETRI_API const char *petri_archive_problem(const PetriArchive *archive);

// Adds a note to an archive that is written. Returns PETRI_INVALID if it cannot be written.
PETRI_API PetriStatus petri_archive_add_note(PetriArchive *archive, const char *text);

// Contents of an archive.
typedef struct PetriArchiveInfo {
    size_t size;         // number of bytes of the struct that are filled
    const char *script;  // file name of the first script
    const char *command; // command line that created the archive; "": unknown
    const char *version; // version of petri that created the archive
    int64_t first_frame; // first recorded frame
    int64_t last_frame;  // last recorded frame; less than first_frame: none
    int64_t keyframes;
    int64_t digests;
    int64_t inputs;
    int64_t files;          // versions of files
    int64_t file_bytes;     // total size of these files
    int64_t sealed_frame;   // frame of the last keyframe, up to which `sha256` covers the archive
    const char *sha256;     // digest of the run, in hexadecimal digits
    int64_t digest_every;   // number of frames from one digest to the next
    int64_t keyframe_every; // number of frames from one keyframe to the next
    const char *spec;       // version of the specification by which the run was computed (PetriOptions.spec)
} PetriArchiveInfo;

// Gets the contents of an archive that was opened. The strings are valid until the archive is closed. Returns false if
// the archive cannot be read.
PETRI_API bool petri_archive_info(PetriArchive *archive, PetriArchiveInfo *info, size_t size);

// A version of a file in an archive.
typedef struct PetriArchiveFile {
    size_t size;      // number of bytes of the struct that are filled
    const char *name; // relative to the script's folder
    int64_t frame;    // first frame that used this version
    const char *sha256;
    const char *bytes; // NULL: from this frame on, there was no such file
    size_t length;
} PetriArchiveFile;

// Gets a version of a file by number, in the order in which they were read. Returns false past the last, or if the
// archive cannot be read. The pointers are valid until the archive is closed.
PETRI_API bool petri_archive_file(PetriArchive *archive, size_t number, PetriArchiveFile *file, size_t size);

// Gets a parameter of the first script, by number. Returns false past the last. The strings are valid until the next
// call of this function.
PETRI_API bool petri_archive_parameter(PetriArchive *archive, size_t number, const char **name, const char **value);

// A keyframe of an archive.
typedef struct PetriArchiveKeyframe {
    size_t size; // number of bytes of the struct that are filled
    int64_t frame;
    // True if the host set this state, so that it does not follow from earlier frames. This is the case for the first
    // keyframe, and after petri_reset, petri_rewind and petri_restore.
    bool given;
    int64_t end; // last recorded frame before the next keyframe, or that keyframe's frame
} PetriArchiveKeyframe;

// Gets a keyframe by number. Returns false past the last, or if the archive cannot be read.
PETRI_API bool petri_archive_keyframe(PetriArchive *archive, size_t number, PetriArchiveKeyframe *keyframe,
                                      size_t size);

// Gets the recorded digest of a frame (petri_digest). Returns false if there is none.
PETRI_API bool petri_archive_digest(PetriArchive *archive, int64_t frame, uint8_t digest[16]);

// Provides the files of an archive: set PetriOptions.read_file to this function and read_user_data to the archive.
// Returns the version of a file that the next frame of the replay uses, or NULL. Valid until the archive is closed.
PETRI_API const char *petri_archive_read(void *archive, const char *name, size_t *length);

// Begins a replay in a session that was opened for the archive (petri_archive_read) and has no script yet. Frames are
// computed by the rules by which they were recorded, unless PetriOptions.spec was set. Loads the
// nearest keyframe at or before `frame`, or the first one, and computes no frame, so that petri_tree and petri_system
// return nothing before the next step. petri_step then computes the recorded frames with their recorded inputs and
// times. After the last recorded frame, the run continues without recorded input. You can use petri_rewind during a
// replay; values of petri_set_global are not part of snapshots. Returns PETRI_INVALID, with
// petri_archive_problem or a diagnostic, if the archive is damaged. Call it again to go to another keyframe.
PETRI_API PetriStatus petri_archive_load(PetriArchive *archive, PetriSession *session, int64_t frame);

// Like petri_archive_load, but then computes the frames up to `frame`; -1 computes none. Returns PETRI_INVALID for the
// same reasons, and the statuses of petri_step.
PETRI_API PetriStatus petri_archive_replay(PetriArchive *archive, PetriSession *session, int64_t frame);

// Ends a replay: its session continues without recorded input. It still reads its files from the archive.
PETRI_API void petri_archive_end_replay(PetriArchive *archive);

// Returns true if the current frame of a replay has a keyframe with another state. Returns false if it has no keyframe,
// or if the keyframe's state was given.
PETRI_API bool petri_archive_keyframe_differs(PetriArchive *archive);

// Checks that an archive is not damaged: reads all rows and computes the digest of the run again. Returns
// PETRI_INVALID, with petri_archive_problem, if it is damaged.
PETRI_API PetriStatus petri_archive_check(PetriArchive *archive);

#ifdef __cplusplus
}
#endif

#endif
