// fuzz_resume.c: fuzzes trajectories that a run continues. The first byte of the input selects CSV or XYZ and the frame
// after which the run continues. The rest is the file. The file is only shortened, and reading it again must not change
// it.
#include "cli/hdf5.h"
#include "fuzz.h"
#include "run/resume.h"

#include <sys/stat.h>
#include <unistd.h>

static bool resume_once(const char *path, bool csv, int64_t after, ResumeFile *file) {
    struct stat info;
    XyzNames names = {0};
    bool opened = resume_open(file, path, csv ? NULL : &names, after);
    xyz_free(&names);
    if (!opened)
        return false;
    if (fstat(file->fd, &info) != 0 || (size_t)info.st_size != file->end || file->last > after)
        fuzz_fail("the file does not end with the last frame");
    close(file->fd);
    return true;
}

FUZZ_HARNESS(resume) {
    ResumeFile first, second;
    if (size == 0)
        return 0;
    bool csv = data[0] & 1;
    int64_t after = (data[0] >> 1) - 1;
    fuzz_put("trajectory", data + 1, size - 1);
    const char *path = fuzz_file("trajectory");
    if (!resume_once(path, csv, after, &first))
        return 0;
    if (!resume_once(path, csv, after, &second) || first.end != second.end || first.last != second.last ||
        first.dimensions != second.dimensions)
        fuzz_fail("a shortened file is not read as before");
    resume_report_gap(path, first.last, &(Resume){true, after, after});
    return 0;
}
