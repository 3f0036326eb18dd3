// screen.c: see screen.h.
#include "view/screen.h"

#include <errno.h>
#include <netdb.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MOST_SECONDS = 3, X11_PORT = 6000, LONGEST_NAME = 256, QUESTION = 12 };

static const Screen SCREENS[] = {{"x11", "DISPLAY"}, {"wayland", "WAYLAND_DISPLAY"}};
enum { X11, WAYLAND, SCREEN_COUNT };

const Screen *screen_kind(size_t number) {
    return number < SCREEN_COUNT ? &SCREENS[number] : NULL;
}

const char *screen_name(const Screen *screen) {
    const char *name = getenv(screen->variable);
    return name != NULL && name[0] != '\0' ? name : NULL;
}

static bool reach(const struct sockaddr *address, socklen_t length, int *connection) {
    *connection = socket(address->sa_family, SOCK_STREAM, 0);
    if (*connection >= 0 && connect(*connection, address, length) == 0) {
        return true;
    }
    if (*connection >= 0) {
        close(*connection);
    }
    return false;
}

// `hidden`: a name that is in no file system, as Linux has them.
static bool reach_path(const char *path, bool hidden, int *connection) {
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    size_t length = strlen(path);
    if (length + 1 >= sizeof address.sun_path) {
        return false;
    }
    memcpy(address.sun_path + (hidden ? 1 : 0), path, length);
    return reach((const struct sockaddr *)&address, (socklen_t)(offsetof(struct sockaddr_un, sun_path) + length + 1),
                 connection);
}

static bool reach_host(const char *host, long number, int *connection) {
    char port[32];
    struct addrinfo hints = {.ai_socktype = SOCK_STREAM}, *found = NULL;
    snprintf(port, sizeof port, "%ld", X11_PORT + number);
    if (getaddrinfo(host, port, &hints, &found) != 0) {
        return false;
    }
    bool reached = false;
    for (const struct addrinfo *one = found; one != NULL && !reached; one = one->ai_next) {
        reached = reach(one->ai_addr, one->ai_addrlen, connection);
    }
    freeaddrinfo(found);
    return reached;
}

// [PROTOCOL/][HOST]:NUMBER[.SCREEN]; without a host it is this machine, by the ways that Xlib tries.
static bool reach_x11(const char *name, int *connection) {
    char host[LONGEST_NAME], path[64];
    const char *slash = strchr(name, '/'), *start = slash == NULL ? name : slash + 1, *colon = strrchr(start, ':');
    if (name[0] == '/' || colon == NULL || (size_t)(colon - start) >= sizeof host) {
        return name[0] == '/' && reach_path(name, false, connection);
    }
    long number = strtol(colon + 1, NULL, 10);
    size_t skip = start[0] == '[' ? 1 : 0; // as in [::1]:0
    snprintf(host, sizeof host, "%.*s", (int)(colon - start - (long)(2 * skip)), start + skip);
    if (host[0] != '\0' && strcmp(host, "unix") != 0) {
        return reach_host(host, number, connection);
    }
    snprintf(path, sizeof path, "/tmp/.X11-unix/X%ld", number);
    return reach_path(path, true, connection) || reach_path(path, false, connection) ||
           reach_host("localhost", number, connection);
}

static bool reach_wayland(const char *name, int *connection) {
    char path[LONGEST_NAME];
    const char *folder = getenv("XDG_RUNTIME_DIR");
    bool whole = name[0] == '/';
    if (!whole && folder == NULL) {
        return false;
    }
    snprintf(path, sizeof path, "%s%s%s", whole ? "" : folder, whole ? "" : "/", name);
    return reach_path(path, false, connection);
}

// Asks for something that is always answered: X11 for a connection without rights, Wayland for a sign of life. Numbers
// are in this machine's order of bytes, which X11 has to be told.
static bool ask(const Screen *screen) {
    const uint16_t one = 1;
    unsigned char x11[QUESTION] = {*(const unsigned char *)&one == 1 ? 'l' : 'B'}, answer;
    const uint32_t wayland[QUESTION / 4] = {1, QUESTION << 16, 2}; // object 1: request 0 makes object 2
    int connection = -1;
    memcpy(x11 + 2, &(uint16_t){11}, 2);
    bool is_x11 = screen == &SCREENS[X11];
    if (!(is_x11 ? reach_x11 : reach_wayland)(screen_name(screen), &connection)) {
        return false;
    }
    return write(connection, is_x11 ? (const void *)x11 : wayland, QUESTION) == QUESTION &&
           read(connection, &answer, 1) == 1;
}

// In a process of its own, which can be given up whatever it is waiting for.
bool screen_answers(const Screen *screen) {
    pid_t child = fork();
    if (child == 0) {
        alarm(MOST_SECONDS);
        _exit(ask(screen) ? 0 : 1);
    }
    int status = 1;
    while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return child < 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 0); // without processes SDL may find out
}
