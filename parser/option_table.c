#include "parser/option.h"

#define AT(member) ((long)offsetof(struct options, member))

enum {
    MAX_SIDE = 1 << 24,
    MAX_FRAME = 1 << 30,
    MAX_THREADS = 4096,
    MAX_DEPTH = 1 << 20
};

static const struct option_word backend_words[] = {
    {"auto", BRUME_BACKEND_AUTO, false},
    {"cpu", BRUME_BACKEND_CPU, false},
    {"cuda", BRUME_BACKEND_CUDA, false},
    {NULL, 0, false},
};

static const struct option_word integrator_words[] = {
    {"path", BRUME_INTEGRATOR_PATH, false},
    {"photon", BRUME_INTEGRATOR_PHOTON, false},
    {"progressive", BRUME_INTEGRATOR_PROGRESSIVE, false},
    {NULL, 0, false},
};

static const struct option_word tree_words[] = {
    {"bvh", BRUME_TREE_BVH, false},
    {"kd", BRUME_TREE_KD, false},
    {"both", BRUME_TREE_BOTH, false},
    {NULL, 0, false},
};

static const struct option_word tree_on_words[] = {
    {"auto", 0, false},
    {"cpu", 1, false},
    {NULL, 0, false},
};

static const struct option_word preset_words[] = {
    {"paper", 1, false},
    {NULL, 0, false},
};

static const struct option_word transport_words[] = {
    {"pov", 0, false},
    {"full", 1, false},
    {NULL, 0, false},
};

static const struct option_word depth_words[] = {
    {"axis", PARSE_DEPTH_AXIS, false},
    {"ray", PARSE_DEPTH_RAY, false},
    {"none", PARSE_DEPTH_NONE, false},
    {NULL, 0, false},
};

static const struct option_word dither_words[] = {
    {"B2", 0, false}, {"B3", 0, false}, {"B4", 0, false}, {"D1", 0, false},
    {"D2", 0, false}, {"FS", 0, false}, {NULL, 0, false},
};

static const struct option_word check_words[] = {
    {"", OPTIONS_CHECK, false},
    {"json", OPTIONS_CHECK_JSON, false},
    {NULL, 0, false},
};

static const struct option_word explain_words[] = {
    {"", OPTIONS_EXPLAIN, false},
    {"json", OPTIONS_EXPLAIN_JSON, false},
    {NULL, 0, false},
};

static const struct option_word progress_words[] = {
    {"auto", OPTIONS_PROGRESS_AUTO, false},
    {"off", OPTIONS_PROGRESS_OFF, false},
    {"json", OPTIONS_PROGRESS_JSON, false},
    {NULL, 0, false},
};

static const struct option_word help_words[] = {
    {"", OPTIONS_HELP, false},
    {NULL, 0, false},
};

static const struct option_word version_words[] = {
    {"", OPTIONS_VERSION, false},
    {NULL, 0, false},
};

/* A row without any name is a heading of --help. */
#define HEADING(text)                                                          \
    {                                                                          \
        .help = text                                                           \
    }

/* Known to POV-Ray and of no effect here; the value is checked all the same. */
#define IGNORED(plus_, ini_, value_, set_, help_)                              \
    {                                                                          \
        .plus = plus_, .ini = ini_, .value = value_, .set = set_,              \
        .at = OPTION_NOWHERE, .help = help_                                    \
    }

#define MISSING(plus_, ini_, name_, value_, set_, help_)                       \
    {                                                                          \
        .plus = plus_, .ini = ini_, .name = name_, .value = value_,            \
        .set = set_, .at = OPTION_NOWHERE, .help = help_                       \
    }

#define STREAM(name, stream)                                                   \
    {.ini = name "_Console",                                                   \
     .set = set_flag,                                                          \
     .at = AT(console[stream]),                                                \
     .initial = 1},                                                            \
    {                                                                          \
        .ini = name "_File", .value = "file", .set = set_stream_file,          \
        .at = stream                                                           \
    }

#define SHELL(name)                                                            \
    {.ini = name "_Command",                                                   \
     .value = "text",                                                          \
     .set = set_shell,                                                         \
     .at = OPTION_NOWHERE},                                                    \
    {                                                                          \
        .ini = name "_Return", .value = "x", .set = set_text,                  \
        .at = OPTION_NOWHERE                                                   \
    }

/* clang-format off */
const struct option option_table[] = {
    HEADING("Scene"),
    { .plus = "I", .ini = "Input_File_Name", .value = "file", .set = set_input,
      .at = OPTION_NOWHERE, .help = "the scene; - is standard input" },
    { .plus = "L", .ini = "Library_Path", .value = "dir", .set = set_folder,
      .at = AT(library), .help = "look for files in DIR too; adds up" },
    { .plus = "HI", .ini = "Include_Header", .value = "file", .set = set_text,
      .at = AT(header), .help = "include FILE before the scene" },
    { .plus = "MV", .ini = "Version", .value = "n.n", .set = set_number,
      .at = AT(version), .low = 0.5, .high = 3.8,
      .help = "version of the language at the start" },
    { .ini = "Declare", .value = "name=n", .set = set_declare,
      .at = OPTION_NOWHERE, .help = "declare a number for the scene" },
    { .name = "allow-read", .value = "dir", .set = set_folder,
      .at = AT(allow_read),
      .help = "scenes may include and read from DIR too" },
    { .name = "allow-write", .value = "dir", .set = set_folder,
      .at = AT(allow_write), .help = "scenes may write to DIR too" },
    { .name = "include-depth", .value = "n", .set = set_integer,
      .at = AT(include_depth), .low = 1, .high = MAX_DEPTH,
      .help = "files within files; 64" },
    { .name = "macro-depth", .value = "n", .set = set_integer,
      .at = AT(macro_depth), .low = 1, .high = MAX_DEPTH,
      .help = "macros within macros; 65536" },
    { .name = "iterations", .value = "n", .set = set_unsigned,
      .at = AT(iterations), .help = "of a scene's loops; 10^9" },
    { .name = "tokens", .value = "n", .set = set_unsigned, .at = AT(tokens),
      .help = "of a scene, loops unrolled; 10^10" },
    { .name = "parse-time", .value = "seconds", .set = set_number,
      .at = AT(parse_seconds), .low = 1e-3, .high = 1e9,
      .help = "for reading a scene; none" },

    HEADING("Picture"),
    { .plus = "W", .ini = "Width", .value = "n", .set = set_integer,
      .at = AT(width), .low = 1, .high = MAX_SIDE, .initial = 640,
      .help = "pixels across" },
    { .plus = "H", .ini = "Height", .value = "n", .set = set_integer,
      .at = AT(height), .low = 1, .high = MAX_SIDE, .initial = 480,
      .help = "pixels down" },
    { .plus = "O", .ini = "Output_File_Name", .value = "file", .set = set_text,
      .at = AT(output),
      .help = "picture; - is standard output" },
    { .plus = "F", .ini = "Output_to_File", .value = "[type[bits]]",
      .set = set_output_file, .at = AT(to_file), .initial = 1,
      .help = "N PNG, E OpenEXR, P PPM; -F: no file" },
    { .ini = "Output_File_Type", .value = "type[bits]", .set = set_file_type,
      .at = OPTION_NOWHERE, .help = "type of the file" },
    { .ini = "Bits_Per_Color", .value = "n", .set = set_integer,
      .at = AT(bits), .low = 5, .high = 16, .initial = 8,
      .help = "of PNG and PPM: up to 8, or up to 16" },
    { .plus = "UA", .ini = "Output_Alpha", .set = set_flag, .at = AT(alpha),
      .help = "leave the background out, write alpha" },
    { .name = "plate", .value = "file", .set = set_numbered, .at = AT(plate),
      .help = "an EXR that is seen behind; %04d: frame" },
    { .name = "plate-layer", .value = "name", .set = set_text,
      .at = AT(plate_layer), .help = "of an EXR with layers" },
    { .name = "plate-depth", .value = "name", .set = set_word,
      .at = AT(plate_depth), .words = depth_words,
      .help = "its Z is along the axis, ray, or none" },
    { .plus = "SC", .ini = "Start_Column", .value = "n", .set = set_number,
      .at = AT(start_column), .low = 0, .high = MAX_SIDE, .initial = -1,
      .help = "first column from 1, or fraction below 1" },
    { .plus = "EC", .ini = "End_Column", .value = "n", .set = set_number,
      .at = AT(end_column), .low = 0, .high = MAX_SIDE, .initial = -1,
      .help = "last column, or fraction up to 1" },
    { .plus = "SR", .ini = "Start_Row", .value = "n", .set = set_number,
      .at = AT(start_row), .low = 0, .high = MAX_SIDE, .initial = -1,
      .help = "first row from 1, or fraction below 1" },
    { .plus = "ER", .ini = "End_Row", .value = "n", .set = set_number,
      .at = AT(end_row), .low = 0, .high = MAX_SIDE, .initial = -1,
      .help = "last row, or fraction up to 1" },

    HEADING("Animation"),
    { .plus = "K", .ini = "Clock", .value = "n.n", .set = set_clock,
      .at = AT(clock), .help = "clock of a single picture" },
    { .plus = "KFI", .ini = "Initial_Frame", .value = "n", .set = set_integer,
      .at = AT(initial_frame), .low = -MAX_FRAME, .high = MAX_FRAME,
      .initial = 1, .help = "number of the first frame" },
    { .plus = "KFF", .ini = "Final_Frame", .value = "n", .set = set_integer,
      .at = AT(final_frame), .low = -MAX_FRAME, .high = MAX_FRAME,
      .initial = 1, .help = "number of the last frame" },
    { .plus = "KI", .ini = "Initial_Clock", .value = "n.n", .set = set_number,
      .at = AT(initial_clock), .help = "clock of the first frame" },
    { .plus = "KF", .ini = "Final_Clock", .value = "n.n", .set = set_number,
      .at = AT(final_clock), .initial = 1, .help = "clock of the last frame" },
    { .plus = "KC", .ini = "Cyclic_Animation", .set = set_flag,
      .at = AT(cyclic), .help = "the frame after the last is the first" },
    { .plus = "SF", .ini = "Subset_Start_Frame", .value = "n",
      .set = set_number, .at = AT(subset_start), .low = 0, .high = MAX_FRAME,
      .initial = -1, .help = "render from frame N, or fraction below 1" },
    { .plus = "EF", .ini = "Subset_End_Frame", .value = "n", .set = set_number,
      .at = AT(subset_end), .low = 0, .high = MAX_FRAME, .initial = -1,
      .help = "render up to frame N, or fraction below 1" },
    { .plus = "STP", .ini = "Frame_Step", .value = "n", .set = set_integer,
      .at = AT(frame_step), .low = 1, .high = MAX_FRAME, .initial = 1,
      .help = "render every Nth frame" },
    { .plus = "C", .ini = "Continue_Trace", .name = "resume", .set = set_flag,
      .at = AT(resume), .help = "leave out what is finished" },
    { .name = "shard", .value = "i/n", .set = set_shard, .at = OPTION_NOWHERE,
      .help = "part I of N of the frames; or: slurm" },

    HEADING("Rendering"),
    { .name = "backend", .value = "name", .set = set_word, .at = AT(backend),
      .words = backend_words, .help = "auto, cpu or cuda" },
    { .name = "integrator", .value = "name", .set = set_integrator,
      .at = AT(integrator), .words = integrator_words,
      .help = "path, photon or progressive" },
    { .name = "photons", .value = "n", .set = set_photons,
      .at = OPTION_NOWHERE,
      .help = "emitted for each field of light" },
    { .name = "field-spacing", .value = "h", .set = set_number,
      .at = AT(field_spacing), .low = 1e-30, .high = 1e30,
      .help = "side of its cells, in units of the scene" },
    { .name = "field-depth", .value = "t", .set = set_number,
      .at = AT(field_depth), .low = 1e-30, .high = 1e30,
      .help = "larger cells up to that optical thickness" },
    { .name = "preset", .value = "name", .set = set_word, .at = AT(preset),
      .words = preset_words, .help = "paper: the published choices" },
    { .name = "temporal", .value = "n", .set = set_temporal,
      .at = OPTION_NOWHERE,
      .help = "1, 3, 5 frames, W,W,W or adaptive" },
    { .name = "transport", .value = "name", .set = set_transport,
      .at = AT(full_transport), .words = transport_words,
      .help = "pov, or full: all light, many bounces" },
    { .name = "spp", .value = "n", .set = set_integer, .at = AT(spp), .low = 1,
      .high = BRUME_MAX_SPP, .help = "samples of each pixel" },
    { .name = "error", .value = "e", .set = set_number, .at = AT(error),
      .low = 1e-6, .high = 1e3,
      .help = "stop at this estimated relative error" },
    { .name = "time", .value = "seconds", .set = set_number, .at = AT(seconds),
      .low = 1e-3, .high = 1e9, .help = "stop after SECONDS, for each frame" },
    { .plus = "WT", .ini = "Work_Threads", .name = "threads", .value = "n",
      .set = set_integer, .at = AT(threads), .low = 0, .high = MAX_THREADS,
      .help = "0: as many as processors" },
    { .name = "gpus", .value = "n", .set = set_gpus, .at = AT(gpus),
      .low = 1, .high = BRUME_MAX_WORKERS,
      .help = "of a film: that many GPUs, or all" },
    { .name = "tree", .value = "name", .set = set_word, .at = AT(tree),
      .words = tree_words, .help = "bvh, kd or both: how surfaces are found" },
    { .name = "tree-on", .value = "name", .set = set_word,
      .at = AT(tree_on_cpu), .words = tree_on_words,
      .help = "auto or cpu: where it is built" },
    { .name = "stack", .value = "n", .set = set_integer, .at = AT(tree_stack),
      .low = 1, .high = 32, .initial = 4, .help = "of the kd-tree" },
    { .name = "seed", .value = "n", .set = set_unsigned, .at = AT(seed),
      .help = "of the random numbers" },
    { .name = "memory", .value = "bytes", .set = set_bytes, .at = AT(memory),
      .help = "limit; K, M, G or T may follow" },
    { .plus = "Q", .ini = "Quality", .value = "n", .set = set_quality,
      .at = OPTION_NOWHERE, .low = 0, .high = 99, .initial = 9,
      .help = "below 9 only warns: it is always full" },

    HEADING("What to do, and what to tell"),
    { .name = "check", .value = "[=json]", .set = set_action,
      .at = AT(action), .words = check_words,
      .help = "read the scene, tell all errors" },
    { .name = "reference", .value = "file", .set = set_text,
      .at = AT(reference), .help = "of brume measure: compare with this" },
    { .name = "budget", .value = "s", .set = set_number, .at = AT(budget),
      .low = 0.001, .high = 1e9, .help = "of brume measure: its seconds" },
    { .name = "repeat", .value = "n", .set = set_integer, .at = AT(repeat),
      .low = 1, .high = 10000, .help = "of brume measure --temporal: films" },
    { .name = "explain", .value = "[=json]", .set = set_action,
      .at = AT(action), .words = explain_words,
      .help = "print the plan, render nothing" },
    { .name = "stats", .value = "file", .set = set_text, .at = AT(stats),
      .help = "write statistics as JSON" },
    { .name = "progress", .value = "name", .set = set_word,
      .at = AT(progress), .words = progress_words,
      .help = "auto, off, or json on standard error" },
    { .plus = "V", .ini = "Verbose", .set = set_flag, .at = AT(verbose),
      .help = "tell of each frame; -V: no progress" },
    { .plus = "GD", .value = "[file]", .set = set_stream, .at = OPTIONS_DEBUG,
      .help = "show #debug, and copy it to FILE" },
    { .plus = "GF", .value = "[file]", .set = set_stream, .at = OPTIONS_FATAL,
      .help = "the same of errors; always shown" },
    { .plus = "GR", .value = "[file]", .set = set_stream,
      .at = OPTIONS_RENDERING, .help = "the same of what is rendered" },
    { .plus = "GS", .value = "[file]", .set = set_stream,
      .at = OPTIONS_STATISTICS, .help = "the same of statistics" },
    { .plus = "GW", .value = "[file]", .set = set_stream,
      .at = OPTIONS_WARNING, .help = "the same of warnings" },
    { .plus = "GA", .value = "[file]", .set = set_stream, .at = OPTIONS_ALL,
      .help = "all of these" },
    { .plus = "GP", .ini = "Append_File", .set = set_flag, .at = AT(append),
      .help = "append to those files" },
    { .plus = "WL", .ini = "Warning_Level", .value = "n", .set = set_integer,
      .at = AT(warning_level), .low = 0, .high = 10, .initial = 10,
      .help = "0: no warnings" },
    { .name = "help", .set = set_action, .at = AT(action), .words = help_words,
      .help = "print this" },
    { .name = "version", .set = set_action, .at = AT(action),
      .words = version_words, .help = "print the version" },

    HEADING("INI options for the text streams"),
    STREAM("Debug", OPTIONS_DEBUG),
    STREAM("Fatal", OPTIONS_FATAL),
    STREAM("Render", OPTIONS_RENDERING),
    STREAM("Statistic", OPTIONS_STATISTICS),
    STREAM("Warning", OPTIONS_WARNING),
    { .ini = "All_Console", .set = set_console, .at = OPTIONS_ALL,
      .initial = 1 },
    { .ini = "All_File", .value = "file", .set = set_stream_file,
      .at = OPTIONS_ALL },

    HEADING("Accepted as POV-Ray has them, without effect"),
    IGNORED("A", "Antialias", "[n.n]", set_flag_number,
            "pixels are always filtered"),
    IGNORED(NULL, "Antialias_Threshold", "n.n", set_number, NULL),
    IGNORED("AM", "Sampling_Method", "n", set_integer, NULL),
    IGNORED("AG", "Antialias_Gamma", "n.n", set_number, NULL),
    IGNORED("R", "Antialias_Depth", "n", set_integer, NULL),
    IGNORED("J", "Jitter", "[n.n]", set_flag_number, NULL),
    IGNORED(NULL, "Jitter_Amount", "n.n", set_number, NULL),
    IGNORED("D", "Display", "[xy]", set_display,
            "there is no preview window"),
    IGNORED(NULL, "Video_Mode", "x", set_text, NULL),
    IGNORED(NULL, "Palette", "x", set_text, NULL),
    IGNORED(NULL, "Display_Gamma", "x", set_text, NULL),
    IGNORED("P", "Pause_When_Done", NULL, set_flag, NULL),
    IGNORED("X", "Test_Abort", "[n]", set_flag_number,
            "signals always stop it"),
    IGNORED(NULL, "Test_Abort_Count", "n", set_integer, NULL),
    IGNORED("SP", "Preview_Start_Size", "n", set_integer, NULL),
    IGNORED("EP", "Preview_End_Size", "n", set_integer, NULL),
    IGNORED(NULL, "File_Gamma", "x", set_file_gamma, "PNG and PPM are sRGB"),
    { .plus = "TH", .ini = "Dither", .value = "[xx]", .set = set_dither,
      .at = OPTION_NOWHERE, .words = dither_words },
    { .ini = "Dither_Method", .value = "xx", .set = set_known_word,
      .at = OPTION_NOWHERE, .words = dither_words },
    IGNORED(NULL, "Compression", "n", set_integer, NULL),
    IGNORED(NULL, "Buffer_Output", NULL, set_flag, NULL),
    IGNORED(NULL, "Buffer_Size", "n", set_number, NULL),
    IGNORED("MI", "Max_Image_Buffer_Memory", "n", set_number, NULL),
    IGNORED("MB", "Bounding", "[n]", set_flag_number,
            "there is always a tree"),
    IGNORED(NULL, "Bounding_Threshold", "n", set_number, NULL),
    IGNORED("BM", "Bounding_Method", "n", set_integer, NULL),
    IGNORED(NULL, "BSP_MaxDepth", "n", set_number, NULL),
    IGNORED(NULL, "BSP_BaseAccessCost", "n.n", set_number, NULL),
    IGNORED(NULL, "BSP_ChildAccessCost", "n.n", set_number, NULL),
    IGNORED(NULL, "BSP_IsectCost", "n.n", set_number, NULL),
    IGNORED(NULL, "BSP_MissChance", "n.n", set_number, NULL),
    IGNORED("UL", "Light_Buffer", NULL, set_flag, NULL),
    IGNORED("UV", "Vista_Buffer", NULL, set_flag, NULL),
    IGNORED("UD", "Draw_Vistas", NULL, set_flag, NULL),
    IGNORED("UR", "Remove_Bounds", NULL, set_flag, NULL),
    IGNORED("SU", "Split_Unions", NULL, set_flag, NULL),
    IGNORED("BS", "Render_Block_Size", "n", set_integer, NULL),
    IGNORED("RP", "Render_Pattern", "n", set_integer, NULL),
    IGNORED("RS", "Render_Block_Step", "n", set_integer, NULL),
    IGNORED("HR", "High_Reproducibility", NULL, set_flag,
            "pictures always are"),
    IGNORED("RVP", "Radiosity_Vain_Pretrace", NULL, set_flag, NULL),

    HEADING("Known, with a warning: no shell command is ever run"),
    SHELL("Pre_Scene"),
    SHELL("Pre_Frame"),
    SHELL("Post_Frame"),
    SHELL("Post_Scene"),
    SHELL("User_Abort"),
    SHELL("Fatal_Error"),

    HEADING("Known, not supported yet"),
    MISSING("GI", "Create_Ini", NULL, "[file]", set_missing_flag, NULL),
    MISSING("UF", "Field_Render", NULL, NULL, set_missing_flag, NULL),
    MISSING("UO", "Odd_Field", NULL, NULL, set_missing_flag, NULL),
    MISSING(NULL, "Grayscale_Output", NULL, NULL, set_missing_flag, NULL),
    MISSING("RF", "Radiosity_File_Name", NULL, "file", set_missing, NULL),
    MISSING("RFI", "Radiosity_From_File", NULL, NULL, set_missing_flag, NULL),
    MISSING("RFO", "Radiosity_To_File", NULL, NULL, set_missing_flag, NULL),
    MISSING(NULL, NULL, "preview", NULL, set_missing,
            "show the picture as it comes"),
};
/* clang-format on */

const int option_count = sizeof option_table / sizeof *option_table;
