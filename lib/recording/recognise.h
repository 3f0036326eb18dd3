// recognise.h: the identification of archives.
#pragma once

#include <stdbool.h>

// Returns true if an open file starts like an archive.
bool archive_has_header(int file);

#define ARCHIVE_APPLICATION_ID 0x50745269 // application id of the database: "PtRi"
