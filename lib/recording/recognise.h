// recognise.h: the identification of archives.
#pragma once

#include <stdbool.h>
#include <sys/stat.h>

// Opens a regular file for reading, and sets *info to its state. Other files are not even opened, because a pipe could
// block or lose its reader. `flags` can be O_NOFOLLOW. Returns -1 if the file is not regular or cannot be opened.
int archive_open_regular(const char *path, int flags, struct stat *info);
// Returns true if an open file starts like an archive.
bool archive_has_header(int file);

#define ARCHIVE_APPLICATION_ID 0x50745269 // application id of the database: "PtRi"
