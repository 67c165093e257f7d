/* reel_parts.h - what reel.c and reel_film.c share. */
#ifndef PARSER_REEL_PARTS_H
#define PARSER_REEL_PARTS_H
#include "parser/reel.h"

/* The code of an error that is told now, but for BRUME_STOPPED. */
enum brume_code reel_fail(const struct reel *reel,
                          const struct brume_error *err);
/* `user` is a struct reel. */
void reel_warn(void *user, const char *text);

/* Reads the scene of the record's frame and tells what is wrong with it. On
 * success the caller frees scene->scene, else it is NULL. `origins` may be
 * NULL. */
enum brume_code reel_read(struct reel *reel, struct reel_record *record,
                          struct parse_result *scene,
                          struct parse_origins *origins);

/* How a frame is to be rendered. */
struct brume_options reel_options(struct reel *reel, int number,
                                  const struct parse_result *scene);

/* Renders the frames and writes their pictures. */
enum brume_code reel_film(struct reel *reel);
#endif
