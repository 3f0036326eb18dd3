// option_list.h: the options of all commands, in the order of help. To add an option, add its rows here.
//
// FIELD(type, name, default): a field of Options (options.h).
// OPTION(commands, "name", 'letter' or 0, "VALUE" or NULL, reader, field, "help"): an option. The readers are in
// options.c. FOR_GOLDEN marks options that are allowed in a golden file, because they write no files.
// clang-format off
FIELD(const char *, output,       NULL)           // render, run LINK, sweep: output file
FIELD(const char *, format,       NULL)           // render: format for `-o -`; NULL: not given
FIELD(int64_t,      frame,        -1)             // render, link: frame number; -1: not given
FIELD(bool,         terminal,     false)          // view: show in the terminal
FIELD(bool,         full_screen,  false)          // view
FIELD(const char *, window,       NULL)           // render, view: id or number of the window to draw; NULL: not given
FIELD(int64_t,      screen,       -1)             // view: number of the screen; -1: not given
FIELD(bool,         update,       false)
FIELD(const char *, filter,       NULL)
FIELD(const char *, junit,        NULL)
FIELD(int64_t,      jobs,         0)              // 0: not given
FIELD(TextList,     axes,         {0})            // sweep: each "NAME=VALUES"
FIELD(const char *, sample,       NULL)           // sweep: sampling; NULL: all combinations
FIELD(int64_t,      seeds,        0)
FIELD(const char *, where,        NULL)
FIELD(const char *, until,        NULL)
FIELD(TextList,     metrics,      {0})            // sweep: each "NAME=EXPR" or the name of a quantity (motion.h)
FIELD(int64_t,      row_every,    0)              // sweep: number of frames from one row to the next; 0: a row for the last frame only
FIELD(const char *, summary,      NULL)
FIELD(const char *, plot,         NULL)
FIELD(const char *, plan,         NULL)
FIELD(bool,         against,      false)          // diff: options of the second run follow
FIELD(const char *, with,         NULL)           // diff: program of the second run; NULL: this one
FIELD(bool,         json,         false)
FIELD(const char *, shard,        NULL)
FIELD(const char *, archive,      NULL)           // file; NULL: none
FIELD(int64_t,      from,         -1)             // first frame of an archive's replay; -1: not given
FIELD(int64_t,      keyframe_every, 1000)
FIELD(int64_t,      digest_every, 1)
FIELD(int64_t,      sample_segments, 0)           // verify: 0: all
FIELD(int64_t,      frames,       -1)             // -1: not given; INT64_MAX: unlimited
FIELD(double,       run_time,     NAN)            // seconds; NaN: unlimited
FIELD(int64_t,      every,        1)
FIELD(Size,         size,         {0})            // size of pictures in pixels; 0: the size that the script sets
FIELD(double,       scale,        1)
FIELD(bool,         automatic,    false)          // draw the particles instead of the canvas
FIELD(TextList,     definitions,  {0})            // each "NAME=VALUE"
FIELD(double,       fps,          60)
FIELD(bool,         fps_given,    false)
FIELD(bool,         realtime,     false)
FIELD(unsigned,     sections,     0)              // PETRI_PRINT_... bits; 0: only logs
FIELD(TextList,     read_folders, {0})            // folders that scripts may read
FIELD(TextList,     write_folders, {0})
FIELD(bool,         no_files,     false)
FIELD(const char *, state_file,   NULL)           // NULL: none
FIELD(int64_t,      save_every,   0)              // frames between saves; 0: every few seconds
FIELD(int64_t,      limit,        100000)         // repl: maximum frames of .run and .until
FIELD(int64_t,      threads,      0)              // 0: number of CPUs
FIELD(uint64_t,     memory,       0)              // bytes; 0: default of the library
FIELD(uint64_t,     work,         0)              // units per frame; 0: default of the library
FIELD(int,          neighbours,   0)              // PetriNeighbours
FIELD(const char *, as_threads,   NULL)           // test: overrides --threads of goldens; NULL: no override
FIELD(const char *, as_neighbours, NULL)          // test: overrides --neighbours of goldens; NULL: no override
FIELD(bool,         unsimplified, false)
FIELD(bool,         no_batches,   false)
FIELD(bool,         keep_modules, false)          // modules are not read again during the run
FIELD(bool,         show,         false)          // run: show the picture if output is a terminal
FIELD(bool,         stats,        false)
FIELD(const char *, trajectory,   NULL)           // file; NULL: none
FIELD(bool,         energies,     false)          // in the trajectory
FIELD(bool,         profile,      false)
FIELD(Verbosity,    verbosity,    LOG_NORMAL)
FIELD(bool,         colour,       colour_by_default())
FIELD(bool,         monochrome,   no_colour())    // no colours even in terminal pictures
FIELD(bool,         werror,       false)
FIELD(const char *, listen,       NULL)           // view: path of a Unix socket
FIELD(const char *, send,         NULL)           // view --send: path of the socket
FIELD(const char *, html,         NULL)           // link: file; NULL: not given
FIELD(const char *, page,         NULL)           // link: URL of the page; NULL: not given
FIELD(bool,         stdio,        false)
FIELD(int,          report,       0)              // check: ReportForm
FIELD(bool,         only_checks,  false)          // fmt: write nothing
FIELD(bool,         parameters,   false)          // list the parameters instead of running
FIELD(int,          dump,         -1)             // PetriDump; -1: not given
FIELD(const char *, cache,        NULL)           // sweep: folder; NULL: none
FIELD(double,       verify_cache, 0)              // sweep: percentage

OPTION(FOR_RENDER, "output", 'o', "FILE", read_text, output, "write to OUT.png, OUT%05d.png (one per frame), OUT.svg, OUT.pdf, or a video such as OUT.mp4 or OUT.gif; - for standard output")
OPTION(FOR_RENDER, "format", 0, "F", read_text, format, "select the format for '-o -': png, svg, pdf, mp4, m4v, mov, mkv, webm, ogg or gif (default: png)")
OPTION(FOR_RENDER, "frame", 0, "N", WHOLE(0, INT64_MAX - 1), frame, "draw only frame N, counted from 0 (default: the last)")
OPTION(FOR_OPEN, "output", 'o', "FILE", read_text, output, "write the script (FILE.fl, - for standard output) or the picture of the frame (.png, .svg, .pdf)")
OPTION(FOR_LINK, "frame", 0, "N", WHOLE(0, 1000000), frame, "also store the frame number N and the digest of that frame's state")
OPTION(FOR_LINK, "html", 0, "FILE", read_text, html, "write a page to FILE that contains the script, its files and the engine, and runs without a network")
OPTION(FOR_LINK, "page", 0, "ADDRESS", read_text, page, "print a whole URL, with the playground at ADDRESS (default: print only the part from '#')")
OPTION(FOR_VIEW, "terminal", 0, NULL, read_flag, terminal, "show the picture in the terminal even if there is a display")
OPTION(FOR_VIEW, "fullscreen", 0, NULL, read_flag, full_screen, "fill the screen; the key f switches it off")
OPTION(FOR_VIEW, "screen", 0, "N", WHOLE(0, 63), screen, "open the window on screen N, counted from 0 (default: 0)")
OPTION(FOR_VIEW, "auto", 0, NULL, read_flag, automatic, "show the particles instead of the script's canvas")
OPTION(FOR_VIEW, "listen", 0, "SOCKET", read_text, listen, "accept code from `petri view --send` on the Unix socket SOCKET, only from the same user")
OPTION(FOR_VIEW | FOR_SEND, "send", 0, "SOCKET", read_text, send, "send code, the operand, to the view that listens on SOCKET, and print its answer")
OPTION(FOR_TEST, "update", 0, NULL, read_flag, update, "update goldens to the current output")
OPTION(FOR_TEST, "filter", 0, "TEXT", read_text, filter, "run only scripts whose path relative to PATH contains TEXT")
OPTION(FOR_TEST, "junit", 0, "FILE", read_text, junit, "also write the results to FILE as JUnit XML, for CI")
OPTION(FOR_TEST, "jobs", 0, "N", WHOLE(1, 256), jobs, "run N scripts at a time (default: number of CPUs)")
OPTION(FOR_LSP, "stdio", 0, NULL, read_flag, stdio, "use standard input and output (default; there is no other transport)")
OPTION(FOR_FMT, "check", 0, NULL, read_flag, only_checks, "list unformatted scripts without changing them; exit with 1 if there are any")
OPTION(FOR_SWEEP, "define", 'D', "NAME=VALUES", read_definition, axes, "set the values of a parameter, such as 1..10, 0..1|0.05 or 1;5;20; may be repeated")
OPTION(FOR_SWEEP, "sample", 0, "latin:N", read_text, sample, "choose N runs by Latin hypercube sampling instead of all combinations; latin:N:SEED sets its seed")
OPTION(FOR_SWEEP, "seeds", 0, "N", WHOLE(1, 1000000), seeds, "repeat each combination N times, with SEED from 1 to N")
OPTION(FOR_SWEEP, "where", 0, "EXPR", read_text, where, "run only combinations for which EXPR is true, such as 'A < B'")
OPTION(FOR_SWEEP, "metric", 0, "NAME=EXPR", read_metric, metrics, "measure EXPR as column NAME, or one of: energy, kinetic_energy, potential_energy, momentum, angular_momentum; may be repeated")
OPTION(FOR_SWEEP, "frames", 0, "N", WHOLE(0, INT64_MAX), frames, "end each run after N frames (default: 600)")
OPTION(FOR_SWEEP, "until", 0, "EXPR", read_text, until, "end each run after the first frame in which EXPR is true")
OPTION(FOR_SWEEP, "every", 0, "K", WHOLE(1, INT64_MAX), row_every, "also write a row for every K-th frame (default: only the last)")
OPTION(FOR_SWEEP, "output", 'o', "FILE", read_text, output, "write the table to FILE and resume if it is partial (default: standard output)")
OPTION(FOR_SWEEP, "summary", 0, "FILE", read_text, summary, "write the mean, standard deviation and quartiles of each metric over the seeds to FILE")
OPTION(FOR_SWEEP, "plot", 0, "FILE", read_text, plot, "plot each metric against each parameter in FILE (.svg, .png or .pdf)")
OPTION(FOR_SWEEP, "plan", 0, "FILE", read_text, plan, "read the script and the options from FILE; the command line overrides them")
OPTION(FOR_SWEEP, "jobs", 0, "N", WHOLE(1, 1024), jobs, "execute N runs in parallel (default: number of CPUs)")
OPTION(FOR_SWEEP, "cache", 0, "DIR", read_text, cache, "store the results of runs in the folder DIR, and do not compute runs again whose results are there")
OPTION(FOR_SWEEP, "verify-cache", 0, "P%", read_percentage, verify_cache, "compute P % of the runs that have a result in the cache again, and report differences (default: 0)")
OPTION(FOR_SWEEP, "shard", 0, "I/N", read_text, shard, "divide the runs into N parts and execute only part I")
OPTION(FOR_RUN | FOR_GOLDEN | FOR_RENDER, "frames", 0, "N", WHOLE(0, INT64_MAX), frames, "stop after N frames (default: 600 without --runtime)")
OPTION(FOR_DIFF, "frames", 0, "N", WHOLE(0, INT64_MAX), frames, "compare N frames (default: 600)")
OPTION(FOR_DIFF, "against", 0, NULL, read_flag, against, "begin the operand and options of the second run")
OPTION(FOR_DIFF, "with", 0, "PROGRAM", read_text, with, "compute the second run with PROGRAM, another build of petri")
OPTION(FOR_DIFF, "json", 0, NULL, read_flag, json, "print the result as JSON")
OPTION(FOR_VIEW, "frames", 0, "N", WHOLE(0, INT64_MAX), frames, "close after N frames")
OPTION(FOR_RUN | FOR_GOLDEN | FOR_RENDER, "runtime", 0, "T", read_time, run_time, "stop after a time T: seconds, or minutes and hours as m:s or h:m:s")
OPTION(FOR_VIEW, "runtime", 0, "T", read_time, run_time, "close after a time T: seconds, or minutes and hours as m:s or h:m:s")
OPTION(FOR_RENDER, "every", 0, "K", WHOLE(1, INT64_MAX), every, "draw every K-th frame, starting with the first")
OPTION(FOR_RENDER, "size", 0, "WxH", read_size, size, "set the picture size in pixels (default: the size of the script's window)")
OPTION(FOR_RENDER, "scale", 0, "S", read_positive, scale, "multiply the size of the picture in pixels by S (default: 1)")
OPTION(FOR_RENDER, "window", 0, "WINDOW", read_text, window, "draw the window with this id or number, counted from 0 (default: the first with content)")
OPTION(FOR_VIEW, "window", 0, "WINDOW", read_text, window, "show only the window with this id or number, counted from 0 (default: all windows; in a terminal, the first)")
OPTION(FOR_RENDER, "auto", 0, NULL, read_flag, automatic, "draw the particles instead of the script's canvas")
OPTION(FOR_DIFF | FOR_REPL | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_VIEW, "fps", 0, "F", read_fps, fps, "set the frames per second (default: 60); '%pragma fps' in a script overrides it")
OPTION(FOR_RUN | FOR_GOLDEN | FOR_RENDER, "lockstep", 0, NULL, read_unset, realtime, "run as fast as possible with time = frame/fps (default)")
OPTION(FOR_RUN | FOR_GOLDEN | FOR_RENDER, "realtime", 0, NULL, read_flag, realtime, "follow the wall clock; frame 0 is at time 0")
OPTION(FOR_VIEW, "lockstep", 0, NULL, read_unset, realtime, "run as fast as possible with time = frame/fps")
OPTION(FOR_VIEW, "realtime", 0, NULL, read_flag, realtime, "follow the wall clock (default); frame 0 is at time 0")
OPTION(FOR_RUN | FOR_GOLDEN, "print", 0, "LIST", ONE_OF(read_sections, "tree", "state", "log", "error", "hash", "digest"), sections, "print the listed items: tree, state, log, error, hash (SHA-256 of the state), digest (faster hash of the state), separated by commas (default: only log)")
OPTION(FOR_RUN | FOR_GOLDEN, "every", 0, "K", WHOLE(1, INT64_MAX), every, "print and record every K-th frame, starting with frame 0")
OPTION(FOR_DIFF | FOR_REPL | FOR_RUN | FOR_GOLDEN | FOR_RENDER | FOR_LINK | FOR_VIEW, "define", 'D', "NAME=VALUE", read_definition, definitions, "set a parameter of the script; may be repeated")
OPTION(FOR_LSP | FOR_CHECK, "define", 'D', "NAME=VALUE", read_definition, definitions, "define a name for the scripts; may be repeated")
OPTION(FOR_RUN | FOR_RENDER | FOR_VIEW, "state", 0, "FILE", read_text, state_file, "load the state from FILE if the file exists; save the state to FILE")
OPTION(FOR_RUN, "save-every", 0, "K", WHOLE(1, INT64_MAX), save_every, "save the state every K frames (default: every few seconds)")
OPTION(FOR_REPL, "state", 0, "FILE", read_text, state_file, "start with the state in FILE")
OPTION(FOR_DIFF | FOR_LSP | FOR_CHECK | FOR_REPL | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_VIEW, "allow-read", 0, "DIR", read_folder, read_folders, "also allow reading below DIR; `all`: everywhere")
OPTION(FOR_LSP | FOR_CHECK | FOR_REPL | FOR_RUN | FOR_RENDER | FOR_VIEW, "allow-write", 0, "DIR", read_folder, write_folders, "also allow writing pictures (!record) below DIR; `all`: everywhere")
OPTION(FOR_DIFF | FOR_LSP | FOR_CHECK | FOR_REPL | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_VIEW, "no-files", 0, NULL, read_flag, no_files, "forbid reading and writing files")
OPTION(FOR_REPL, "limit", 0, "N", WHOLE(1, INT64_MAX), limit, "limit .run and .until to N frames (default: 100000)")
OPTION(FOR_DIFF | FOR_REPL | FOR_RUN | FOR_GOLDEN | FOR_RENDER | FOR_LINK | FOR_OPEN | FOR_VIEW, "threads", 0, "N", WHOLE(1, 1024), threads, "use N worker threads (default: number of CPUs); does not change results")
OPTION(FOR_SWEEP, "threads", 0, "N", WHOLE(1, 1024), threads, "use N worker threads per run (default: 1); does not change results")
OPTION(FOR_TEST, "threads", 0, "N", read_text, as_threads, "run all scripts with --threads N")
OPTION(FOR_DIFF | FOR_LSP | FOR_CHECK | FOR_REPL | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_LINK | FOR_OPEN | FOR_VIEW | FOR_VERIFY | FOR_INFO, "memory", 0, "BYTES", read_amount, memory, "limit the script's memory, e.g. 512M (default: 2G)")
OPTION(FOR_DIFF | FOR_LSP | FOR_CHECK | FOR_REPL | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_LINK | FOR_OPEN | FOR_VIEW | FOR_VERIFY, "work", 0, "N", read_amount, work, "limit each frame to N units of work (default: 1G, about 10 s)")
OPTION(FOR_DIFF | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_VIEW, "neighbours", 0, "WHEN", ONE_OF(read_choice, "auto", "never", "always"), neighbours, "use neighbour lists: auto, never or always; does not change results")
OPTION(FOR_TEST, "neighbours", 0, "WHEN", read_text, as_neighbours, "run all scripts with --neighbours WHEN")
OPTION(FOR_DIFF | FOR_TEST | FOR_REPL | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_VIEW, "nosimplify", 0, NULL, read_flag, unsimplified, "evaluate the whole script in every frame, without simplifying it; does not change results")
OPTION(FOR_DIFF | FOR_TEST | FOR_RUN, "no-batches", 0, NULL, read_flag, no_batches, "execute the iterations of loops one by one; does not change results")
OPTION(FOR_RUN, "show", 0, NULL, read_flag, show, "show the picture in the terminal for 10 seconds, or for the length that --runtime or --frames sets; without a terminal or with text output such as --print, print a summary instead")
OPTION(FOR_RUN | FOR_GOLDEN, "stats", 0, NULL, read_flag, stats, "print timings and each system's energy at the end")
OPTION(FOR_CHECK, "stats", 0, NULL, read_flag, stats, "print how many triangles the solids, distance fields and models of the first frame have")
OPTION(FOR_RUN, "trajectory", 0, "FILE", read_trajectory, trajectory, "write all particles to FILE.xyz (extended XYZ), FILE.csv or FILE.h5 (H5MD); with --state, append to FILE")
OPTION(FOR_RUN, "energies", 0, NULL, read_flag, energies, "also write kinetic and potential energy of each system to the trajectory, which takes time")
OPTION(FOR_RUN | FOR_VIEW, "archive", 0, "FILE", read_text, archive, "write an archive of the run, which 'petri archive verify' can verify, to FILE.petri")
OPTION(FOR_RUN | FOR_RENDER | FOR_VIEW | FOR_REPL, "from", 0, "FRAME", WHOLE(0, INT64_MAX - 1), from, "start the replay of an archive with this frame (default: the first)")
OPTION(FOR_RUN | FOR_VIEW, "keyframe-every", 0, "N", WHOLE(1, INT64_MAX - 1), keyframe_every, "store the state in the archive every N frames (default: 1000)")
OPTION(FOR_RUN | FOR_VIEW, "digest-every", 0, "K", WHOLE(1, INT64_MAX - 1), digest_every, "store a digest of every K-th frame in the archive (default: 1)")
OPTION(FOR_VERIFY, "sample", 0, "K", WHOLE(1, INT64_MAX), sample_segments, "verify only K segments, chosen at random")
OPTION(FOR_VERIFY, "threads", 0, "N", WHOLE(1, 1024), threads, "verify N segments at a time (default: number of CPUs)")
OPTION(FOR_RUN | FOR_GOLDEN, "profile", 0, NULL, read_flag, profile, "print the time per source line, slowest first")
OPTION(FOR_DIFF | FOR_CHECK | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_LINK | FOR_OPEN | FOR_VIEW | FOR_VERIFY, "quiet", 0, NULL, VERBOSITY(LOG_QUIET), verbosity, "report only errors")
OPTION(FOR_RUN | FOR_GOLDEN | FOR_RENDER | FOR_VIEW, "verbose", 0, NULL, VERBOSITY(LOG_VERBOSE), verbosity, "also report a summary at the end")
OPTION(FOR_RUN | FOR_GOLDEN | FOR_RENDER | FOR_VIEW, "debug", 0, NULL, VERBOSITY(LOG_DEBUG), verbosity, "also report the time that each printed frame took")
OPTION(FOR_RUN | FOR_GOLDEN | FOR_RENDER | FOR_VIEW, "trace", 0, NULL, VERBOSITY(LOG_TRACE), verbosity, "also report the time that every frame took")
OPTION(FOR_DIFF | FOR_CHECK | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_LINK | FOR_OPEN | FOR_VIEW, "color", 0, "WHEN", ONE_OF(read_colour, "auto", "always", "never"), colour, "use colours in messages: auto, always or never")
OPTION(FOR_REPL, "color", 0, "WHEN", ONE_OF(read_colour, "auto", "always", "never"), colour, "use colours in prompts and messages: auto, always or never")
OPTION(FOR_CHECK, "format", 0, "F", ONE_OF(read_choice, "text", "gcc", "json", "sarif"), report, "output format: text (stderr); gcc, json, sarif (stdout)")
OPTION(FOR_CHECK, "werror", 0, NULL, read_flag, werror, "treat warnings as errors")
OPTION(FOR_RUN | FOR_GOLDEN, "parameters", 0, NULL, read_flag, parameters, "list the parameters that -D can set, with default, range and comment; do not run")
OPTION(FOR_RUN | FOR_GOLDEN, "dump", 0, "WHAT", ONE_OF(read_choice, "ast", "code"), dump, "print the script's syntax tree (ast) or compiled code (code); do not run")
