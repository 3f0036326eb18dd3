// render.c: `petri render`, which writes an image of a frame, a series of images or a video.
#include "base/clock.h"
#include "cli/memory.h"
#include "cli/shader_test.h"
#include "cli/stdout_file.h"
#include "render/frame_writer.h"
#include "render/options.h"
#include "render/output_names.h"
#include "render/video.h"
#include "render/window_option.h"
#include "run/frames.h"

#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef enum OutputKind { OUTPUT_PICTURE, OUTPUT_SERIES, OUTPUT_FILM } OutputKind;

enum { MAX_WINDOWS = 64 }; // maximum number of windows of a frame that are written

typedef struct Render {
    Frames frames;
    OutputKind kind;
    PetriPictureOptions picture;
    FrameWriter *writer;
    PetriPainter *sampler;    // renders the pictures that the script samples
    ShaderTester tester;      // of `sampler`
    int64_t drawn;            // number of frames drawn for the output
    bool thread_running;      // true if a thread is still drawing an abandoned picture
    PetriPicture *held;       // picture of the last frame, if it is drawn when the next frame is known; else NULL
    bool held_must;           // true if `held` must be drawn even if the next frame does not depend on it
    bool failed;              // true after a failure: no more frames are drawn
    StdoutFile stdout_file;   // temporary file, for output to standard output
    const char *display_name; // name of the output in messages
} Render;

// Determines the kind of output. Returns false after a message.
static bool read_output(Render *render) {
    Options *options = render->frames.options;
    RenderOptions *own = render_options(options);
    if (!own->output) {
        message("option '--output' is missing; try: petri render %s -o OUT.png", options->script);
        return false;
    }
    if (own->format && !stdout_file_is_requested(own->output)) {
        message("option '--format' is only for '-o -'; the format of '%s' follows from its suffix", own->output);
        return false;
    }
    if (stdout_file_is_requested(own->output)) {
        if (!stdout_file_check(own->format) || !stdout_file_open(&render->stdout_file, own->format))
            return false;
        own->output = render->stdout_file.file;
    }
    render->display_name = render->stdout_file.file ? "-" : own->output;
    if (video_has_suffix(own->output)) {
        render->kind = OUTPUT_FILM;
    } else if (!petri_picture_can_save(own->output)) {
        message("unknown suffix: '%s'; use .png, .svg, .pdf, .mp4, .m4v, .mov, .mkv, .webm, .ogg or .gif", own->output);
        return false;
    } else {
        render->kind = output_has_number(own->output) ? OUTPUT_SERIES : OUTPUT_PICTURE;
    }
    if (options->frame >= 0 && render->kind == OUTPUT_FILM) {
        message("option '--frame' is for images; '%s' is a video", render->display_name);
        return false;
    }
    if (options->frame >= 0)
        options->frames = options->frame + 1 - (options->from > 0 ? options->from : 0);
    return true;
}

// Checks that the folder is writable before frames are computed. Returns false after a message.
static bool check_folder(const char *file) {
    SCOPED_STRING folder = memory_folder(file);
    bool good = access(folder, W_OK | X_OK) == 0;
    if (!good)
        message("cannot write '%s': %s", file, strerror(errno));
    return good;
}

// The outputs of a frame: one, or one for each window.
typedef struct OutputList {
    FrameOutput items[MAX_WINDOWS];
    char *names[MAX_WINDOWS]; // the file names of `items`
    int count;
} OutputList;

// Adds an output for a window. Returns false after a message.
static bool add_output(const Render *render, const PetriPicture *picture, int window, OutputList *list) {
    const char *pattern = render_options(render->frames.options)->output;
    if (list->count == MAX_WINDOWS) {
        message("cannot write '%s': a frame has more than %d windows", pattern, MAX_WINDOWS);
        return false;
    }
    int64_t frame = render->kind == OUTPUT_SERIES ? petri_picture_frame(picture) : -1;
    char *name = output_name(pattern, frame, window, petri_picture_window_id(picture, window));
    list->names[list->count] = name;
    list->items[list->count++] = (FrameOutput){.window = window, .file = name};
    for (int i = 0; i + 1 < list->count; i++) {
        if (strcmp(list->names[i], name) == 0) {
            message("windows %d and %d have the same file, '%s': give them different ids", list->items[i].window,
                    window, name);
            return false;
        }
    }
    return true;
}

// Lists the files of a picture. Returns false after a message.
static bool list_outputs(const Render *render, const PetriPicture *picture, OutputList *list) {
    bool good = true;
    int window = render->picture.window == PETRI_ALL_WINDOWS ? petri_picture_next_window(picture, -1) : -1;
    for (; window >= 0 && good; window = petri_picture_next_window(picture, window))
        good = add_output(render, picture, window, list);
    if (good && list->count == 0) {
        good = add_output(render, picture, petri_picture_window(picture), list);
        list->items[0].window = -1;
    }
    return good;
}

// Makes the picture of the last computed frame. Returns NULL if a signal has aborted it, or after setting `failed`.
static PetriPicture *make_picture(Render *render) {
    PetriPicture *picture = NULL;
    frames_set_interruptible(&render->frames, true);
    PetriStatus status = petri_picture(render->frames.session, &render->picture, &picture);
    frames_set_interruptible(&render->frames, false);
    if (status == PETRI_OUT_OF_MEMORY) {
        progress_erase(&render->frames.progress);
        message("out of memory");
    }
    render->failed = render->failed || (status != PETRI_OK && status != PETRI_INTERRUPTED);
    if (picture && petri_samples_pictures(render->frames.session))
        petri_picture_render(picture, render->sampler);
    return picture;
}

// Draws a picture, which is freed. If `wanted` is true, writes it to the output. Also writes the files of its `!record`
// nodes. NULL is ignored.
static void draw_picture(Render *render, PetriPicture *picture, bool wanted) {
    if (!picture)
        return;
    OutputList list = {.count = 0};
    render->failed = wanted && !list_outputs(render, picture, &list);
    if (render->failed)
        petri_picture_free(&picture);
    else
        render->failed = !frame_writer_add(render->writer, picture, list.items, (size_t)list.count);
    for (int i = 0; i < list.count; i++)
        free(list.names[i]);
    render->drawn += wanted;
}

// Draws or frees the held picture, after the next frame was computed. `must`: the next frame may depend on it.
static void release_held(Render *render, bool must) {
    if (must || render->held_must)
        draw_picture(render, render->held, false);
    else
        petri_picture_free(&render->held);
    render->held = NULL;
}

// Draws the last computed frame if it is an output or later frames depend on it. A frame that may become the single
// picture is held, because it must not be drawn twice.
static void output_frame(Render *render) {
    const Options *options = render->frames.options;
    PetriSession *session = render->frames.session;
    int64_t number = petri_frame_number(session);
    bool single = render->kind == OUTPUT_PICTURE;
    bool wanted = options->frame >= 0
                      ? number == options->frame
                      : (number - render->frames.before_first_picture) % render_options(options)->every == 0;
    bool must = petri_must_render(session);
    release_held(render, must);
    if (render->failed)
        return;
    if (!single && (wanted || must)) {
        draw_picture(render, make_picture(render), wanted);
    } else if (must || petri_needs_history(session)) {
        render->held = make_picture(render);
        render->held_must = must;
    }
}

// Returns true for the first frames, in which particles have no positions yet (petri_picture_ready). They are computed,
// but neither drawn nor counted, so that a video does not begin with all particles at one point. File names keep the
// frame numbers, and --frame can still select these frames.
static bool is_before_first_picture(const Render *render) {
    return render->frames.options->frame < 0 && !petri_picture_ready(render->frames.session, &render->picture);
}

// Draws a single image of the last frame. If --frame was given, the last frame must be that frame.
static void output_picture(Render *render) {
    const Options *options = render->frames.options;
    int64_t number = petri_frame_number(render->frames.session);
    if (options->frame >= 0 && number != options->frame) {
        message("nothing to draw: the run ended with frame %" PRId64 ", before frame %" PRId64, number, options->frame);
        render->failed = true;
    } else {
        PetriPicture *picture = render->held ? render->held : make_picture(render);
        render->held = NULL;
        draw_picture(render, picture, true);
    }
}

static void report_summary(const Render *render) {
    const Frames *frames = &render->frames;
    Verbosity verbosity = frames->options->verbosity;
    if (verbosity < LOG_NORMAL || (verbosity == LOG_NORMAL && !isatty(STDERR_FILENO)))
        return;
    double seconds = clock_seconds() - frames->start;
    message("%" PRId64 " frame%s in %.3f s (%.1f frames/s), %" PRId64 " drawn in %.3f s of thread time", frames->done,
            frames->done == 1 ? "" : "s", seconds, seconds > 0 ? (double)frames->done / seconds : 0, render->drawn,
            frame_writer_seconds(render->writer));
}

// Reports what was kept after a signal: videos and series keep the frames drawn so far; a single picture is not
// written.
static void report_stop(const Render *render, bool saved) {
    const char *frames = render->drawn == 1 ? "frame" : "frames";
    if (!saved) {
        message("stopped; '%s' was not written", render->display_name);
    } else if (render->kind == OUTPUT_FILM) {
        message("stopped; '%s' is complete, with the %" PRId64 " %s drawn so far", render->display_name, render->drawn,
                frames);
    } else {
        message("stopped; '%s' has the %" PRId64 " %s drawn so far", render->display_name, render->drawn, frames);
    }
}

static int end_render(Render *render, bool going) {
    const char *error_text = NULL;
    Frames *frames = &render->frames;
    int stopped = frames_signal();
    bool keeps = render->kind != OUTPUT_PICTURE && render->drawn > 0;
    bool abandon = (stopped != 0 && !keeps) || !going || render->failed;
    bool good = frame_writer_finish(render->writer, frames->session, abandon, &error_text);
    if (frame_writer_unfinished_count(render->writer) > 0) {
        render->thread_running = true;
        render->drawn -= frame_writer_unfinished_count(render->writer);
        stopped = frames_signal(); // a signal may have arrived in the meantime
        keeps = keeps && render->drawn > 0;
    }
    frames_end(frames, going);
    if (error_text)
        message("%s", error_text);
    if (stopped != 0) {
        report_stop(render, keeps && (good || render->thread_running));
        return frames->state.outdated ? STATUS_FAILED : STATUS_SIGNAL + stopped;
    }
    if (!going || !good || state_file_failed(&frames->state))
        return STATUS_FAILED;
    if (render->drawn == 0) {
        message("no frame was drawn; '%s' was not written", render->display_name);
        return STATUS_FAILED;
    }
    report_summary(render);
    // For example, a shader crashed the driver, or a limit left out a part of a picture.
    return petri_diagnostic_count(frames->session, PETRI_ERROR) == 0 ? STATUS_DONE : STATUS_FAILED;
}

static int render_frames(Render *render) {
    Frames *frames = &render->frames;
    const Options *options = frames->options;
    const RenderOptions *own = render_options(options);
    double fps = frames_fps(frames);
    render->writer = frame_writer_start(render->kind == OUTPUT_FILM, fps / (double)own->every, fps);
    if (!render->writer)
        return STATUS_FAILED;
    frames_begin(frames);
    bool going = true;
    while (going && !render->failed && frames_due(frames)) {
        going = frames_step(frames) || frames->abandoned;
        if (frames->abandoned)
            break;
        render->picture.window = window_option(frames->session, own->window,
                                               output_has_window(own->output) ? PETRI_ALL_WINDOWS : PETRI_FIRST_WINDOW);
        petri_picture_follow(frames->session, &render->picture);
        if (going && is_before_first_picture(render))
            frames->before_first_picture++;
        else if (going)
            output_frame(render);
        frame_writer_report(render->writer, frames->session);
        if (going)
            frames_save_state(frames);
    }
    if (going && !render->failed && frames_signal() == 0 && frames->done > 0 && render->kind == OUTPUT_PICTURE)
        output_picture(render);
    petri_picture_free(&render->held);
    int status = end_render(render, going);
    if (!render->thread_running)
        frame_writer_free(render->writer);
    return status;
}

static int render_script(Render *render) {
    const Options *options = render->frames.options;
    const RenderOptions *own = render_options(options);
    if (!read_output(render))
        return STATUS_USAGE;
    render->picture = petri_default_picture_options();
    render->picture.width = own->size.width;
    render->picture.height = own->size.height;
    render->picture.scale = own->scale;
    render->picture.automatic = own->automatic ? PETRI_AUTO_ALWAYS : PETRI_AUTO_IF_NEEDED;
    render->tester.pending_signal = frames_signal;
    render->sampler = painter_open_tested(&render->tester);
    petri_painter_serve(render->sampler, render->frames.session);
    if (!check_folder(own->output) || !frames_load(&render->frames))
        return render->frames.invalid_definition ? STATUS_USAGE : STATUS_FAILED;
    return render_frames(render);
}

static int render_run(const CommandContext *context, Options *options) {
    Render render = {0};
    int status = frames_open(&render.frames, context, options);
    if (status == OPTIONS_READ)
        status = render_script(&render);
    if (!stdout_file_send(&render.stdout_file))
        status = STATUS_FAILED;
    stdout_file_close(&render.stdout_file);
    if (render.thread_running) {
        fflush(NULL);
        _exit(status); // frees no memory, because threads may still use it
    }
    petri_close(&render.frames.session);
    petri_painter_close(&render.sampler);
    return status;
}

const Command RENDER_COMMAND = {
    .name = "render",
    .operands = "SCRIPT.fl -o OUT",
    .summary = "render frames to images or video",
    .details =
        "Renders the script's !window, or its particles if it does not draw. The suffix of OUT selects the output: an\n"
        "image of the last frame or of --frame; an image of every frame, if the name contains %d or %05d; or a video,\n"
        "which needs ffmpeg. If the name contains {window}, each window has its own file, with the window's id or\n"
        "number in the place of {window}. '-o -' writes to standard output at the end (petri render dish.fl -o - "
        "--format gif\n"
        ">dish.gif). Ctrl-C ends a video or a series after the current frame and keeps it; a second Ctrl-C discards\n"
        "the video.\n"
        "\n"
        "If a script draws positions that its !physics has stored, frames 0 and 1 have none yet. They are computed,\n"
        "but neither rendered nor counted: the first image is frame 2, and --frames 60 renders 60 frames.",
    .examples = "  petri render dish.fl -o dish.png --frame 100    one image\n"
                "  petri render dish.fl -o dish%05d.png --every 10 every tenth frame\n"
                "  petri render dish.fl -o dish.mp4 --runtime 10   ten seconds as a video\n"
                "  petri render two.fl -o two-{window}.png         an image of each window\n",
    .missing_operand = "no script given",
    .options = &RENDER_OPTIONS,
    .run = render_run,
};
