// video_arguments.c: see video_arguments.h.
//
// Words are not copied. They belong to the tables, to the options or to the VideoArguments, which must not be moved.
#include "render/video_arguments.h"

#include "base/str.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct Container {
    const char *suffix;
    const char *muxer;
    const char *codecs; // codecs that it allows; the first is the default
    bool fast_start;    // true: move the index to the start of the file
} Container;

static const Container containers[] = {
    {".mp4", "mp4", "h264 hevc vp9 av1", true},
    {".m4v", "mp4", "h264 hevc", true},
    {".mov", "mov", "h264 hevc prores", true},
    {".mkv", "matroska", "h264 hevc vp8 vp9 av1 theora prores", false},
    {".webm", "webm", "vp9 vp8 av1", false},
    {".ogg", "ogg", "theora vp8", false},
    {".gif", "gif", "gif", false},
};

typedef struct Codec {
    const char *name;
    const char *words[12];
    const char *pixfmts; // pixel formats that it allows; the first is the default
    int crf;             // default of the constant rate factor
    int max_crf;         // 0: the codec has no such option
    const char *preset;
    const char *profiles; // "": the codec has none
} Codec;

static const Codec codecs[] = {
    {"h264",
     {"-c:v", "libx264"},
     "yuv420p yuv422p yuv444p yuv420p10le yuv422p10le yuv444p10le",
     17,
     51,
     "veryfast",
     "baseline main high high10 high422 high444"},
    {"hevc",
     {"-c:v", "libx265", "-x265-params", "log-level=error"},
     "yuv420p yuv422p yuv444p yuv420p10le yuv422p10le yuv444p10le",
     20,
     51,
     "veryfast",
     "main main10"},
    {"vp8", {"-c:v", "libvpx", "-b:v", "20M", "-deadline", "realtime", "-cpu-used", "6"}, "yuv420p", 10, 63, NULL, ""},
    {"vp9",
     {"-c:v", "libvpx-vp9", "-b:v", "0", "-deadline", "realtime", "-cpu-used", "6", "-row-mt", "1"},
     "yuv420p yuv422p yuv444p yuv420p10le yuv422p10le yuv444p10le",
     24,
     63,
     NULL,
     ""},
    {"av1",
     {"-c:v", "libaom-av1", "-b:v", "0", "-usage", "realtime", "-cpu-used", "8"},
     "yuv420p yuv422p yuv444p yuv420p10le yuv422p10le yuv444p10le",
     30,
     63,
     NULL,
     ""},
    {"theora", {"-c:v", "libtheora", "-q:v", "9"}, "yuv420p yuv422p yuv444p", 0, 0, NULL, ""},
    {"prores", {"-c:v", "prores_ks"}, "yuv422p10le yuv444p10le", 0, 0, NULL, "proxy lt standard hq"},
    {"gif", {NULL}, "rgb8", 0, 0, NULL, ""},
};

static const Container *find_container(const char *file) {
    for (size_t i = 0; i < sizeof containers / sizeof *containers; i++)
        if (strlen(file) > strlen(containers[i].suffix) &&
            str_ends_with(str_from(file), str_from(containers[i].suffix)))
            return &containers[i];
    return NULL;
}

bool video_has_suffix(const char *file) {
    return find_container(file);
}

static const Codec *find_codec(Str name) {
    for (size_t i = 0; i < sizeof codecs / sizeof *codecs; i++)
        if (str_equal(name, str_from(codecs[i].name)))
            return &codecs[i];
    return NULL;
}

static Str first_word(const char *list) {
    return (Str){list, strcspn(list, " ")};
}

static bool is_set(const char *word) {
    return word && word[0] != '\0';
}

static void add(VideoArguments *arguments, const char *word) {
    arguments->words[arguments->count++] = word;
}

// Returns false and sets arguments->problem if the codec does not have the options.
static bool check_options(VideoArguments *arguments, const Codec *codec, const VideoOptions *options) {
    char *problem = arguments->problem;
    size_t size = sizeof arguments->problem;
    bool has_profile = !is_set(options->profile) || str_word_number(str_from(options->profile), codec->profiles) >= 0;
    if (isfinite(options->crf) && codec->max_crf == 0)
        snprintf(problem, size, "the codec '%s' has no option 'crf'", codec->name);
    else if (options->crf > codec->max_crf)
        snprintf(problem, size, "for the codec '%s', crf must be at most %d", codec->name, codec->max_crf);
    else if (is_set(options->preset) && !codec->preset)
        snprintf(problem, size, "the codec '%s' has no option 'preset'", codec->name);
    else if (!has_profile && !codec->profiles[0])
        snprintf(problem, size, "the codec '%s' has no option 'profile'", codec->name);
    else if (!has_profile)
        snprintf(problem, size, "the codec '%s' has no profile '%s', only %s", codec->name, options->profile,
                 codec->profiles);
    else if (is_set(options->pixfmt) && str_word_number(str_from(options->pixfmt), codec->pixfmts) < 0)
        snprintf(problem, size, "the codec '%s' has no pixel format '%s', only %s", codec->name, options->pixfmt,
                 codec->pixfmts);
    return !problem[0];
}

static void add_codec(VideoArguments *arguments, const Codec *codec, const VideoOptions *options) {
    // Many players need an even width and height. Screen colours are those of BT.709.
    static const char *const colours[] = {"-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"};
    Str pixfmt = is_set(options->pixfmt) ? str_from(options->pixfmt) : first_word(codec->pixfmts);
    snprintf(arguments->filter, sizeof arguments->filter,
             "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv,format=%.*s", STR_ARGS(pixfmt));
    add(arguments, "-vf");
    add(arguments, arguments->filter);
    for (size_t i = 0; i < sizeof colours / sizeof *colours; i++)
        add(arguments, colours[i]);
    for (size_t i = 0; codec->words[i]; i++)
        add(arguments, codec->words[i]);
    if (codec->preset) {
        add(arguments, "-preset");
        add(arguments, is_set(options->preset) ? options->preset : codec->preset);
    }
    if (is_set(options->profile)) {
        add(arguments, "-profile:v");
        add(arguments, options->profile);
    }
    if (codec->max_crf) {
        snprintf(arguments->crf, sizeof arguments->crf, "%.0f", isfinite(options->crf) ? options->crf : codec->crf);
        add(arguments, "-crf");
        add(arguments, arguments->crf);
    }
}

bool video_arguments(VideoArguments *arguments, const char *file, const VideoOptions *options) {
    const Container *container = find_container(file);
    const char *names = container->codecs;
    Str name = is_set(options->codec) ? str_from(options->codec) : first_word(names);
    arguments->count = 0;
    arguments->problem[0] = '\0';
    if (str_word_number(name, names) < 0) {
        snprintf(arguments->problem, sizeof arguments->problem, "%s files cannot contain the codec '%.*s', only %s",
                 container->suffix, STR_ARGS(name), names);
        return false;
    }
    const Codec *codec = find_codec(name);
    if (!check_options(arguments, codec, options))
        return false;
    if (codec->words[0]) {
        add_codec(arguments, codec, options);
    } else {
        // Delays in a GIF are whole hundredths of a second, and viewers show a hundredth as a tenth, so that faster
        // films get 50 frames per second. Each frame has its own palette, because a common palette would require all
        // frames in memory.
        add(arguments, "-filter_complex");
        add(arguments, "fps='min(source_fps,50)',split[a][b];[a]palettegen=stats_mode=single[p];[b][p]paletteuse=new=1:"
                       "dither=bayer");
    }
    if (container->fast_start) {
        add(arguments, "-movflags");
        add(arguments, "+faststart");
    }
    add(arguments, "-f");
    add(arguments, container->muxer);
    return true;
}
