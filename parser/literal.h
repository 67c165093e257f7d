/* literal.h - meshes that are spelt out in a text that a film keeps: read
 * once, and taken over from then on. */
#ifndef PARSER_LITERAL_H
#define PARSER_LITERAL_H
#include "parser/expand.h"

/* Behind the '{' of a mesh or mesh2: takes over what was kept of its lists of
 * plain numbers, or reads and keeps them. Where the text is not kept, nothing
 * is done. False: reported. */
bool literal_run(struct expander *expander);
#endif
