// no_watch.c: replaces inotify_init1 in harnesses that watch files (meson.build), because closing its descriptor takes
// 20 ms.
int __wrap_inotify_init1(int flags);

int __wrap_inotify_init1(int flags) {
    (void)flags;
    return -1;
}
