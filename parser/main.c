/* The program: the only place that prints and that ends the process. */
#include "parser/check.h"
#include "parser/console.h"
#include "parser/explain.h"
#include "parser/options.h"
#include "parser/reel.h"
#include "parser/stats.h"
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Set by SIGINT and SIGTERM; a second one of them ends the process at once. */
static volatile sig_atomic_t stop;

/* A run that is told to stop has so many seconds for it. */
enum { PATIENCE = 4 };

static void on_signal(int signal)
{
    (void)signal;
    stop = 1;
    alarm(PATIENCE);
}

/* What can't be heard in time, as in the reading of a large file, is ended:
 * files have their names only when they are whole, and the next run sweeps
 * what was being written. */
static void on_alarm(int signal)
{
    static const char text[] = "stopped in the middle of something long\n";
    (void)signal;
    (void)!write(STDERR_FILENO, text, sizeof text - 1);
    _exit(BRUME_STOPPED);
}

/* Without SA_RESTART, so that a read that waits for input ends too. A closed
 * pipe is an error of writing, told as such. */
static void catch_signals(void)
{
    struct sigaction action = {
        .sa_handler = on_signal,
        .sa_flags = (int)SA_RESETHAND,
    };
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
    signal(SIGALRM, on_alarm);
    signal(SIGPIPE, SIG_IGN);
}

struct run {
    struct options options;
    struct console console;
    struct reel reel;
    struct check check;
    enum brume_code code; /* of what the events below did        */
};

/* ---- events ------------------------------------------------------------ */

static void on_report(void *user, const struct diag *diag)
{
    struct run *run = user;
    if (run->options.action == OPTIONS_CHECK_JSON)
        check_add(&run->check, diag);
    else
        console_diag(&run->console, diag);
}

static void on_message(void *user, enum parse_stream stream, const char *text)
{
    console_message(&((struct run *)user)->console, stream, text);
}

static void on_frame(void *user, const struct frames *frames, int number)
{
    console_frame(&((struct run *)user)->console, frames, number);
}

static void on_progress(void *user, const struct brume_progress *progress)
{
    console_progress(&((struct run *)user)->console, progress);
}

static void on_finished(void *user, const struct reel_record *record)
{
    console_finished(&((struct run *)user)->console, record);
}

static void on_skipped(void *user, const char *picture)
{
    console_skipped(&((struct run *)user)->console, picture);
}

static bool on_stopped(void *user)
{
    (void)user;
    return stop;
}

static enum brume_code tell(struct run *run, const struct brume_error *err)
{
    struct diag diag;
    diag_init(&diag);
    diag_error(&diag, err->code, "%s", err->text);
    on_report(run, &diag);
    diag_release(&diag);
    return err->code;
}

static void on_planned(void *user, const struct brume_plan *plan)
{
    struct run *run = user;
    struct brume_error err = {0};
    if (run->options.action == OPTIONS_EXPLAIN) {
        explain_text(plan, stdout);
        return;
    }
    char *text = explain_json(plan, &err);
    if (text)
        fputs(text, stdout);
    else
        run->code = tell(run, &err);
    free(text);
}

static void on_measured(void *user, const struct measure *measure)
{
    (void)user;
    measure_table(measure, stdout);
}

static void on_flickered(void *user, const struct measure_temporal *measure)
{
    (void)user;
    measure_temporal_table(measure, stdout);
}

/* ---- the run ----------------------------------------------------------- */

static enum brume_code act(struct run *run)
{
    const struct reel_events events = {
        .user = run,
        .report = on_report,
        .message = on_message,
        .frame = on_frame,
        .planned = on_planned,
        .measured = on_measured,
        .flickered = on_flickered,
        .progress = on_progress,
        .finished = on_finished,
        .skipped = on_skipped,
        .stopped = on_stopped,
        .in = stdin,
        .out = stdout,
    };
    struct brume_error err = {0};
    enum brume_code code = reel_run(&run->reel, &run->options, &events);
    if (code == BRUME_STOPPED)
        fprintf(stderr, "stopped; %zu frames were finished\n",
                run->reel.records);
    if (code == BRUME_OK)
        code = run->code;
    const char *stats = run->options.stats;
    if (stats && !stats_write(&run->reel, code, stats, &err))
        code = code ? code : tell(run, &err);
    reel_release(&run->reel);
    return code;
}

static void print_check(struct run *run)
{
    struct brume_error err = {0};
    char *text = check_text(&run->check, &err);
    if (text)
        fputs(text, stdout);
    else
        fprintf(stderr, "error: %s\n", err.text);
    free(text);
}

static enum brume_code render(struct run *run, const struct diag *diag)
{
    struct brume_error err = {0};
    enum brume_code code = BRUME_OK;
    if (!console_open(&run->console, &run->options, stderr,
                      isatty(STDERR_FILENO), &err))
        code = tell(run, &err);
    on_report(run, diag);
    if (!code && !diag->errors && !run->options.input) {
        fputs("error: no scene is given\nhint: brume --help tells what can "
              "be\n",
              stderr);
        code = BRUME_ERR_USAGE;
    }
    if (diag->errors)
        code = diag->code;
    if (!code)
        code = act(run);
    if (run->options.action == OPTIONS_CHECK_JSON)
        print_check(run);
    console_close(&run->console);
    return code;
}

/* -h and -? are POV-Ray's when they stand alone; elsewhere -H is a height. */
static bool asks_for_help(int count, char **word)
{
    static const char *const words[] = {"-h", "-H", "+H", "-?", "-help"};
    for (size_t i = 0; count == 2 && i < sizeof words / sizeof *words; i++)
        if (strcmp(word[1], words[i]) == 0)
            return true;
    return false;
}

/* Whether a filter is one of those of `brume measure --temporal`. */
static bool is_measured(const struct options *o)
{
    struct brume_photon_options known = {0};
    if (o->adaptive)
        return o->taps == BRUME_MAX_TAPS;
    return brume_film_taps(&known, o->taps) &&
           memcmp(known.weight, o->weight,
                  (size_t)o->taps * sizeof *o->weight) == 0;
}

static void check_measure(const struct options *o, struct diag *diag)
{
    bool temporal = o->action == OPTIONS_MEASURE_TEMPORAL;
    bool measure = o->action == OPTIONS_MEASURE || temporal;
    if (o->action != OPTIONS_MEASURE && (o->reference || o->budget > 0))
        diag_error(diag, BRUME_ERR_USAGE,
                   "--reference and --budget are for 'brume measure'");
    if (measure && ((o->spp && !temporal) || o->error > 0 || o->seconds > 0))
        diag_error(diag, BRUME_ERR_USAGE,
                   "'brume measure' tries --spp, --error and --time itself");
    if (!temporal && o->more_photons[0] > 0)
        diag_error(diag, BRUME_ERR_USAGE,
                   "several --photons are for 'brume measure --temporal'");
    if (temporal && o->taps > 0 && !is_measured(o))
        diag_error(diag, BRUME_ERR_USAGE,
                   "'brume measure --temporal' measures 1, 3, 5 and adaptive "
                   "alone");
    if (!temporal && o->repeat > 0)
        diag_error(diag, BRUME_ERR_USAGE,
                   "--repeat is for 'brume measure --temporal'");
    if (measure && o->output && strcmp(o->output, "-") == 0)
        diag_error(diag, BRUME_ERR_USAGE,
                   "'brume measure' writes files; name them by +O");
}

static void read_options(struct options *options, int count, char **word,
                         struct diag *diag)
{
    const char *ini = options_find_ini(options);
    if (ini)
        options_read_ini(options, ini, NULL, diag);
    int first = 1;
    if (count > 1 && strcmp(word[1], "measure") == 0) {
        bool temporal = count > 2 && strcmp(word[2], "--temporal") == 0;
        first = temporal ? 3 : 2;
        options->action = temporal ? OPTIONS_MEASURE_TEMPORAL : OPTIONS_MEASURE;
    }
    if (count > first)
        options_read_words(options, count - first,
                           (const char *const *)(word + first), diag);
    check_measure(options, diag);
}

static enum brume_code start(struct run *run, int count, char **word)
{
    struct diag diag;
    diag_init(&diag);
    read_options(&run->options, count, word, &diag);
    enum options_action action = run->options.action;
    enum brume_code code = BRUME_OK;
    if (asks_for_help(count, word) || action == OPTIONS_HELP)
        options_help(stdout);
    else if (action == OPTIONS_VERSION)
        puts("brume " BRUME_VERSION);
    else
        code = render(run, &diag);
    diag_release(&diag);
    return code;
}

int main(int count, char **word)
{
    struct run run = {.code = BRUME_OK};
    catch_signals();
    options_init(&run.options);
    enum brume_code code = start(&run, count, word);
    options_release(&run.options);
    bool written = fflush(stdout) == 0 && !ferror(stdout);
    if (!written && code == BRUME_OK) {
        fprintf(stderr, "error: can't write to standard output: %s\n",
                strerror(errno));
        code = BRUME_ERR_FILE;
    }
    return code;
}
