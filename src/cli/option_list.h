// option_list.h: all options of all commands, in the order of help, and what they set. A new one is its rows here.
//
// FIELD(type, name, at first): what is asked for, as options.h has it in Options.
// OPTION(commands, "name", 'letter' or 0, "VALUE" or NULL, reader, field, "help"): the readers are in options.c.
// FOR_GOLDEN: a golden may ask for it too, since it writes nothing.
// clang-format off
FIELD(const char *, output,       NULL)           // render: what to write
FIELD(const char *, format,       NULL)           // … to standard output; NULL: not given
FIELD(int64_t,      frame,        -1)             // render: the only one to draw, or -1
FIELD(bool,         terminal,     false)          // view: in the terminal
FIELD(bool,         update,       false)
FIELD(const char *, filter,       NULL)
FIELD(const char *, junit,        NULL)
FIELD(int64_t,      jobs,         0)              // 0: not given
FIELD(TextList,     axes,         {0})            // sweep: each "name=values"
FIELD(const char *, sample,       NULL)           // … NULL: all combinations
FIELD(int64_t,      seeds,        0)
FIELD(const char *, where,        NULL)
FIELD(const char *, until,        NULL)
FIELD(TextList,     metrics,      {0})            // … each "name=expression"
FIELD(int64_t,      row_every,    0)              // … 0: a row for the last frame only
FIELD(const char *, summary,      NULL)
FIELD(const char *, plot,         NULL)
FIELD(const char *, plan,         NULL)
FIELD(const char *, shard,        NULL)
FIELD(int64_t,      frames,       -1)             // INT64_MAX: not limited by their number
FIELD(double,       run_time,     NAN)            // NaN: not limited by time
FIELD(int64_t,      every,        1)
FIELD(Size,         size,         {0})            // of pictures; 0: what the script says
FIELD(double,       scale,        1)
FIELD(bool,         automatic,    false)          // the particles themselves are drawn
FIELD(TextList,     definitions,  {0})            // each "name=value"
FIELD(double,       fps,          60)
FIELD(bool,         fps_given,    false)
FIELD(bool,         realtime,     false)
FIELD(unsigned,     sections,     0)              // PETRI_PRINT_...; 0: logs alone
FIELD(TextList,     read_folders, {0})            // … of scripts
FIELD(TextList,     write_folders, {0})
FIELD(bool,         no_files,     false)
FIELD(const char *, state_file,   NULL)           // NULL: the state is neither taken from a file nor kept in one
FIELD(int64_t,      save_every,   0)              // … after so many frames; 0: every few seconds
FIELD(int64_t,      limit,        100000)         // repl: of .run and .until
FIELD(int64_t,      threads,      0)              // 0: as many as CPUs
FIELD(uint64_t,     memory,       0)              // bytes; 0: as much as the library allows
FIELD(uint64_t,     work,         0)              // likewise
FIELD(int,          neighbours,   0)              // PetriNeighbours
FIELD(const char *, as_threads,   NULL)           // test: for each run; NULL: what the goldens ask for
FIELD(const char *, as_neighbours, NULL)          // likewise
FIELD(bool,         unsimplified, false)
FIELD(bool,         show,         false)          // run: in the terminal, if somebody watches
FIELD(bool,         stats,        false)
FIELD(const char *, trajectory,   NULL)           // NULL: none is written
FIELD(bool,         profile,      false)
FIELD(Verbosity,    verbosity,    LOG_NORMAL)
FIELD(bool,         colour,       colour_by_default())
FIELD(bool,         monochrome,   no_colour())    // not even pictures in the terminal have colours
FIELD(bool,         werror,       false)
FIELD(const char *, listen,       NULL)           // view: a socket for editors
FIELD(const char *, page,         NULL)           // link: its address; NULL: not given
FIELD(bool,         stdio,        false)
FIELD(int,          report,       0)              // check: as text, for gcc's readers, as JSON or as SARIF
FIELD(bool,         only_checks,  false)          // fmt: nothing is written
FIELD(bool,         parameters,   false)          // they are listed, and nothing is run
FIELD(int,          dump,         -1)             // PetriDump, or -1

OPTION(FOR_RENDER, "output", 'o', "FILE", read_text, output, "OUT.png, OUT%05d.png (a series), OUT.svg, OUT.pdf, OUT.mp4, OUT.webm or OUT.gif; - for standard output")
OPTION(FOR_RENDER, "format", 0, "F", read_text, format, "what '-o -' writes: png (if not given), svg, pdf, mp4, webm or gif")
OPTION(FOR_RENDER, "frame", 0, "N", WHOLE(0, INT64_MAX - 1), frame, "draw frame N (0 is the first); the last one if not given")
OPTION(FOR_OPEN, "output", 'o', "FILE", read_text, output, "write the script (FILE.fl, - for standard output) or the picture of the frame (.png, .svg, .pdf)")
OPTION(FOR_LINK, "frame", 0, "N", WHOLE(0, 1000000), frame, "show frame N (0 is the first), and tell the hash of its state")
OPTION(FOR_LINK, "page", 0, "ADDRESS", read_text, page, "the address of the page, which the link begins with; none if not given")
OPTION(FOR_VIEW, "terminal", 0, NULL, read_flag, terminal, "show it in the terminal, even if there is a display")
OPTION(FOR_VIEW, "auto", 0, NULL, read_flag, automatic, "show the particles themselves, not the script's own canvas")
OPTION(FOR_VIEW, "listen", 0, "SOCKET", read_text, listen, "take texts from petri send on a Unix socket, which its owner alone may use")
OPTION(FOR_TEST, "update", 0, NULL, read_flag, update, "record what the scripts print now in their goldens")
OPTION(FOR_TEST, "filter", 0, "TEXT", read_text, filter, "only scripts with TEXT in their path below PATH")
OPTION(FOR_TEST, "junit", 0, "FILE", read_text, junit, "also write the results to FILE, in the form that CI systems read")
OPTION(FOR_TEST, "jobs", 0, "N", WHOLE(1, 256), jobs, "run N scripts at a time (as many as CPUs)")
OPTION(FOR_LSP, "stdio", 0, NULL, read_flag, stdio, "by standard input and output, which is the only way")
OPTION(FOR_FMT, "check", 0, NULL, read_flag, only_checks, "only tell which scripts are to be laid out, and exit with 1 if there are any")
OPTION(FOR_SWEEP, "define", 'D', "NAME=VALUES", read_definition, axes, "values of a parameter: 1..10, 0..1|0.05, 1;5;20, or one; may be repeated")
OPTION(FOR_SWEEP, "sample", 0, "latin:N", read_text, sample, "N runs with values spread evenly over all ranges (a Latin hypercube), not all combinations; latin:N:SEED for others")
OPTION(FOR_SWEEP, "seeds", 0, "N", WHOLE(1, 1000000), seeds, "each combination N times, with SEED from 1 to N")
OPTION(FOR_SWEEP, "where", 0, "EXPR", read_text, where, "only combinations for which EXPR is true, such as 'A < B'")
OPTION(FOR_SWEEP, "metric", 0, "NAME=EXPR", read_definition, metrics, "what is measured; may be repeated")
OPTION(FOR_SWEEP, "frames", 0, "N", WHOLE(0, INT64_MAX), frames, "end a run after N frames (600)")
OPTION(FOR_SWEEP, "until", 0, "EXPR", read_text, until, "end a run after the first frame in which EXPR is true")
OPTION(FOR_SWEEP, "every", 0, "K", WHOLE(1, INT64_MAX), row_every, "a row for each K-th frame, starting with frame 0, and for the last, not for that alone")
OPTION(FOR_SWEEP, "output", 'o', "FILE", read_text, output, "write the table to a file, and go on from what is there of it; to standard output if not given")
OPTION(FOR_SWEEP, "summary", 0, "FILE", read_text, summary, "write mean, deviation and quartiles over the seeds of each combination")
OPTION(FOR_SWEEP, "plot", 0, "FILE", read_text, plot, "draw each metric over each name (.svg, .png or .pdf)")
OPTION(FOR_SWEEP, "plan", 0, "FILE", read_text, plan, "take script and options from a file; those of the command line count more")
OPTION(FOR_SWEEP, "jobs", 0, "N", WHOLE(1, 1024), jobs, "make N runs at a time (as many as CPUs)")
OPTION(FOR_SWEEP, "shard", 0, "I/N", read_text, shard, "make the I-th of N parts of the runs")
OPTION(FOR_RUN | FOR_GOLDEN | FOR_RENDER, "frames", 0, "N", WHOLE(0, INT64_MAX), frames, "stop after N frames (600 if neither this nor --runtime is given)")
OPTION(FOR_VIEW, "frames", 0, "N", WHOLE(0, INT64_MAX), frames, "close after N frames")
OPTION(FOR_RUN | FOR_GOLDEN | FOR_RENDER, "runtime", 0, "T", read_time, run_time, "stop after T seconds, or a time code (m:s, h:m:s)")
OPTION(FOR_VIEW, "runtime", 0, "T", read_time, run_time, "close after T seconds, or a time code (m:s, h:m:s)")
OPTION(FOR_RENDER, "every", 0, "K", WHOLE(1, INT64_MAX), every, "draw each K-th frame, starting with the first")
OPTION(FOR_RENDER, "size", 0, "WxH", read_size, size, "size of the picture in pixels (that of the script's window)")
OPTION(FOR_RENDER, "scale", 0, "S", read_positive, scale, "S pixels for each unit of the window's size (1)")
OPTION(FOR_RENDER, "auto", 0, NULL, read_flag, automatic, "draw the particles themselves, not the script's own canvas")
OPTION(FOR_REPL | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_VIEW, "fps", 0, "F", read_fps, fps, "frames per second (60); a script's %pragma fps wins")
OPTION(FOR_RUN | FOR_GOLDEN | FOR_RENDER, "lockstep", 0, NULL, read_unset, realtime, "time is frame/fps, as fast as possible (the default)")
OPTION(FOR_RUN | FOR_GOLDEN | FOR_RENDER, "realtime", 0, NULL, read_flag, realtime, "follow the wall clock; time counts from frame 0")
OPTION(FOR_VIEW, "lockstep", 0, NULL, read_unset, realtime, "time is frame/fps, as fast as possible")
OPTION(FOR_VIEW, "realtime", 0, NULL, read_flag, realtime, "follow the wall clock (the default); time counts from frame 0")
OPTION(FOR_RUN | FOR_GOLDEN, "print", 0, "LIST", ONE_OF(read_sections, "tree", "state", "log", "error", "hash"), sections, "print any of tree, state, log, error, hash (SHA-256 of the state), with commas; logs alone if not given")
OPTION(FOR_RUN | FOR_GOLDEN, "every", 0, "K", WHOLE(1, INT64_MAX), every, "print and record each K-th frame, starting with frame 0")
OPTION(FOR_REPL | FOR_RUN | FOR_GOLDEN | FOR_RENDER | FOR_LINK | FOR_VIEW, "define", 'D', "NAME=VALUE", read_definition, definitions, "set a parameter of the script; may be repeated")
OPTION(FOR_LSP | FOR_CHECK, "define", 'D', "NAME=VALUE", read_definition, definitions, "define a name for the scripts; may be repeated")
OPTION(FOR_RUN | FOR_RENDER | FOR_VIEW, "state", 0, "FILE", read_text, state_file, "go on from the state in FILE, if it exists, and keep it there")
OPTION(FOR_RUN, "save-every", 0, "K", WHOLE(1, INT64_MAX), save_every, "keep the state of --state after each K-th frame, too, not only every few seconds")
OPTION(FOR_REPL, "state", 0, "FILE", read_text, state_file, "begin with the state in FILE")
OPTION(FOR_LSP | FOR_CHECK | FOR_REPL | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_VIEW, "allow-read", 0, "DIR", read_folder, read_folders, "the script may also read below DIR, not only in its folder and this one; all: everywhere")
OPTION(FOR_LSP | FOR_CHECK | FOR_REPL | FOR_RUN | FOR_RENDER | FOR_VIEW, "allow-write", 0, "DIR", read_folder, write_folders, "the script may also write pictures (!record) below DIR, not only in its folder")
OPTION(FOR_LSP | FOR_CHECK | FOR_REPL | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_VIEW, "no-files", 0, NULL, read_flag, no_files, "the script may neither read nor write files")
OPTION(FOR_REPL, "limit", 0, "N", WHOLE(1, INT64_MAX), limit, "frames that .run and .until make at the most (100000)")
OPTION(FOR_REPL | FOR_RUN | FOR_GOLDEN | FOR_RENDER | FOR_LINK | FOR_OPEN | FOR_VIEW, "threads", 0, "N", WHOLE(1, 1024), threads, "worker threads (as many as CPUs); results never depend on it")
OPTION(FOR_SWEEP, "threads", 0, "N", WHOLE(1, 1024), threads, "worker threads of each run (1); results never depend on it")
OPTION(FOR_TEST, "threads", 0, "N", read_text, as_threads, "as with run, for all scripts")
OPTION(FOR_LSP | FOR_CHECK | FOR_REPL | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_LINK | FOR_OPEN | FOR_VIEW, "memory", 0, "BYTES", read_amount, memory, "bytes that a script may take, such as 512M (2G)")
OPTION(FOR_LSP | FOR_CHECK | FOR_REPL | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_LINK | FOR_OPEN | FOR_VIEW, "work", 0, "N", read_amount, work, "steps of work that a frame of a script may take, such as 4G (1G, some ten seconds)")
OPTION(FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_VIEW, "neighbours", 0, "WHEN", ONE_OF(read_choice, "auto", "never", "always"), neighbours, "lists of neighbours in physics: auto, never or always; results never depend on it")
OPTION(FOR_TEST, "neighbours", 0, "WHEN", read_text, as_neighbours, "as with run, for all scripts")
OPTION(FOR_TEST | FOR_REPL | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_VIEW, "nosimplify", 0, NULL, read_flag, unsimplified, "evaluate everything in every frame; results never depend on it")
OPTION(FOR_RUN, "show", 0, NULL, read_flag, show, "on a terminal, show its picture there for ten seconds (--runtime, --frames: other lengths), if it has one and no text is asked for")
OPTION(FOR_RUN | FOR_GOLDEN, "stats", 0, NULL, read_flag, stats, "close with a table of times, speeds and each system's energy")
OPTION(FOR_RUN, "trajectory", 0, "FILE", read_trajectory, trajectory, "write where the particles are to FILE.xyz (extended XYZ), FILE.csv or FILE.h5 (H5MD); with --state it goes on where the state does")
OPTION(FOR_RUN | FOR_GOLDEN, "profile", 0, NULL, read_flag, profile, "close with the time that each line of the script took, the slowest first")
OPTION(FOR_CHECK | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_LINK | FOR_OPEN | FOR_VIEW, "quiet", 0, NULL, VERBOSITY(LOG_QUIET), verbosity, "report errors only")
OPTION(FOR_RUN | FOR_GOLDEN | FOR_RENDER | FOR_VIEW, "verbose", 0, NULL, VERBOSITY(LOG_VERBOSE), verbosity, "also report a summary at the end")
OPTION(FOR_RUN | FOR_GOLDEN | FOR_RENDER | FOR_VIEW, "debug", 0, NULL, VERBOSITY(LOG_DEBUG), verbosity, "also report the time that each printed frame took")
OPTION(FOR_RUN | FOR_GOLDEN | FOR_RENDER | FOR_VIEW, "trace", 0, NULL, VERBOSITY(LOG_TRACE), verbosity, "also report the time that every frame took")
OPTION(FOR_CHECK | FOR_RUN | FOR_SWEEP | FOR_GOLDEN | FOR_RENDER | FOR_LINK | FOR_OPEN | FOR_VIEW, "color", 0, "WHEN", ONE_OF(read_colour, "auto", "always", "never"), colour, "colour messages: auto, always or never")
OPTION(FOR_REPL, "color", 0, "WHEN", ONE_OF(read_colour, "auto", "always", "never"), colour, "colour prompts and messages: auto, always or never")
OPTION(FOR_CHECK, "format", 0, "F", ONE_OF(read_choice, "text", "gcc", "json", "sarif"), report, "how to tell it: text, with the lines that are meant; on standard output gcc (a line each), json or sarif")
OPTION(FOR_CHECK, "werror", 0, NULL, read_flag, werror, "exit with 1 if there was a warning, too")
OPTION(FOR_RUN | FOR_GOLDEN, "parameters", 0, NULL, read_flag, parameters, "list what -D can set: name, default, range and comment; do not run it")
OPTION(FOR_RUN | FOR_GOLDEN, "dump", 0, "WHAT", ONE_OF(read_choice, "ast", "code"), dump, "print the script's ast or code and do not run it")
