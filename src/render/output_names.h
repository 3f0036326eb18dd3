// output_names.h: file names of a series of pictures: `%d` or `%05d` is the frame number, `{window}` is the window.
#pragma once

#include <stdbool.h>
#include <stdint.h>

// Returns true if the name contains a placeholder for the frame number: its first `%`, if at most two digits and a `d`
// follow.
bool output_has_number(const char *pattern);
// Returns true if the name, without its folder, contains `{window}`.
bool output_has_window(const char *pattern);
// Returns the file name for a frame (-1: the name has no frame number) and a window. `id` replaces `{window}`, or the
// number of the window if `id` is "". Characters of the id that are not letters, digits, `-`, `_` or `.` become `_`,
// and so does a dot at its start. The file is therefore always in the folder of the pattern. The caller frees the name
// with free.
char *output_name(const char *pattern, int64_t frame, int window, const char *id);
