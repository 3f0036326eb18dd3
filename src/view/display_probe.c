// display_probe.c: see display_probe.h.
//
// A child process connects and waits for the answer, so that an alarm can end it without ending petri.
#include "view/display_probe.h"

#include "cli/subprocess.h"

#include <netdb.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

enum { MAX_SECONDS = 3, X11_PORT = 6000, MAX_NAME_LENGTH = 256, REQUEST_BYTES = 12 };

static const DisplayProbe PROBES[] = {{"x11", "DISPLAY"}, {"wayland", "WAYLAND_DISPLAY"}};
enum { X11, WAYLAND, PROBE_COUNT };

const DisplayProbe *display_probe_kind(size_t number) {
    return number < PROBE_COUNT ? &PROBES[number] : NULL;
}

const char *display_probe_name(const DisplayProbe *screen) {
    const char *name = getenv(screen->variable);
    return name && name[0] != '\0' ? name : NULL;
}

static bool connect_socket(const struct sockaddr *address, socklen_t length, int *connection) {
    *connection = socket(address->sa_family, SOCK_STREAM, 0);
    if (*connection >= 0 && connect(*connection, address, length) == 0)
        return true;
    if (*connection >= 0)
        close(*connection);
    return false;
}

// Connects to a Unix socket. If `hidden`, the path is in Linux's abstract namespace instead of the file system.
static bool connect_path(const char *path, bool hidden, int *connection) {
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    size_t length = strlen(path);
    if (length + 1 >= sizeof address.sun_path)
        return false;
    memcpy(address.sun_path + (hidden ? 1 : 0), path, length);
    return connect_socket((const struct sockaddr *)&address,
                          (socklen_t)(offsetof(struct sockaddr_un, sun_path) + length + 1), connection);
}

static bool connect_host(const char *host, long number, int *connection) {
    char port[32];
    struct addrinfo hints = {.ai_socktype = SOCK_STREAM}, *found = NULL;
    snprintf(port, sizeof port, "%ld", X11_PORT + number);
    if (getaddrinfo(host, port, &hints, &found) != 0)
        return false;
    bool reached = false;
    for (const struct addrinfo *one = found; one && !reached; one = one->ai_next)
        reached = connect_socket(one->ai_addr, one->ai_addrlen, connection);
    freeaddrinfo(found);
    return reached;
}

// Connects to [PROTOCOL/][HOST]:NUMBER[.SCREEN]. Without a host, tries the local connections in Xlib's order.
static bool connect_x11(const char *name, int *connection) {
    char host[MAX_NAME_LENGTH], path[64];
    const char *slash = strchr(name, '/'), *start = !slash ? name : slash + 1, *colon = strrchr(start, ':');
    if (name[0] == '/' || !colon || (size_t)(colon - start) >= sizeof host)
        return name[0] == '/' && connect_path(name, false, connection);
    long number = strtol(colon + 1, NULL, 10);
    size_t skip = start[0] == '[' ? 1 : 0; // IPv6 addresses are in brackets, as in [::1]:0
    snprintf(host, sizeof host, "%.*s", (int)(colon - start - (long)(2 * skip)), start + skip);
    if (host[0] != '\0' && strcmp(host, "unix") != 0)
        return connect_host(host, number, connection);
    snprintf(path, sizeof path, "/tmp/.X11-unix/X%ld", number);
    return connect_path(path, true, connection) || connect_path(path, false, connection) ||
           connect_host("localhost", number, connection);
}

static bool connect_wayland(const char *name, int *connection) {
    char path[MAX_NAME_LENGTH];
    const char *folder = getenv("XDG_RUNTIME_DIR");
    bool whole = name[0] == '/';
    if (!whole && !folder)
        return false;
    snprintf(path, sizeof path, "%s%s%s", whole ? "" : folder, whole ? "" : "/", name);
    return connect_path(path, false, connection);
}

// Sends a request that every server answers: for X11, a connection request without authorisation; for Wayland, a sync
// request. Returns true if an answer arrives. Numbers are in native byte order, which the X11 request declares.
static bool send_probe(const DisplayProbe *screen) {
    const uint16_t one = 1;
    unsigned char x11[REQUEST_BYTES] = {*(const unsigned char *)&one == 1 ? 'l' : 'B'}, answer;
    // Request 0 (sync) of object 1, which creates object 2.
    const uint32_t wayland[REQUEST_BYTES / 4] = {1, REQUEST_BYTES << 16, 2};
    int connection = -1;
    memcpy(x11 + 2, &(uint16_t){11}, 2);
    bool is_x11 = screen == &PROBES[X11];
    if (!(is_x11 ? connect_x11 : connect_wayland)(display_probe_name(screen), &connection))
        return false;
    return write(connection, is_x11 ? (const void *)x11 : wayland, REQUEST_BYTES) == REQUEST_BYTES &&
           read(connection, &answer, 1) == 1;
}

// Probes in a child process, which the alarm signal kills if the screen does not answer.
bool display_probe_answers(const DisplayProbe *screen) {
    pid_t child = fork();
    if (child == 0) {
        alarm(MAX_SECONDS);
        _exit(send_probe(screen) ? 0 : 1);
    }
    return child < 0 || subprocess_wait_for(child) == 0; // if petri cannot fork, let SDL try
}
