// recognise.h: the identification of archives.
#pragma once

#define ARCHIVE_APPLICATION_ID 0x50745269 // application id of the database: "PtRi"
