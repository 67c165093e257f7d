/* reel_write.h - a picture is written while the next scenes are read. */
#ifndef PARSER_REEL_WRITE_H
#define PARSER_REEL_WRITE_H
#include <pthread.h>
#include "parser/reel.h"

/* One that is written. */
struct reel_write {
    const struct reel *reel;
    struct reel_record *record; /* says where to; is told the seconds      */
    struct brume_frame frame;   /* its own                                 */
    struct brume_error err;     /* where it failed                         */
    bool good, beside;
    pthread_t thread;
};

/* Writes it, by a thread of its own unless there is to be but one or memory is
 * limited. `w` and all it points to stay where they are until the end. */
void reel_write_begin(struct reel_write *w);
/* Waits until it is written and frees it; false with w->err set. */
bool reel_write_end(struct reel_write *w);
#endif
