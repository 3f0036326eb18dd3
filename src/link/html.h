// html.h: the page that `petri link --html` writes.
#pragma once

#include "link/link_session.h"

// Writes a page with the engine, the script of the session and the files that it has read. `page` is the URL of the
// playground, to which the page links; NULL: that of `./dev web --serve`. Returns an exit status, after a message on
// failure.
int html_write(const LinkSession *link_session, const char *page, const char *file);
