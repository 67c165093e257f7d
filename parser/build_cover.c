/* build_cover.c - a colour over another as a function of core; see cover in
 * surface.c. */
#include "parser/builder.h"

static bool take(struct brume_function *to, int index, struct brume_error *err)
{
    return brume_function_parameter(to, index, err);
}

static bool apply(struct brume_function *to, enum brume_op op,
                  struct brume_error *err)
{
    return brume_function_op(to, op, err);
}

/* max(0, 1 - filter - transmit) of the colour whose parameters begin there. */
static bool write_own_part(struct brume_function *to, int first,
                           struct brume_error *err)
{
    return brume_function_constant(to, 0, err) &&
           brume_function_constant(to, 1, err) && take(to, first + 3, err) &&
           apply(to, BRUME_OP_SUBTRACT, err) && take(to, first + 4, err) &&
           apply(to, BRUME_OP_SUBTRACT, err) && apply(to, BRUME_OP_MAX, err);
}

/* min(1, filter + transmit) of the upper colour, times what `index` is. */
static bool write_through(struct brume_function *to, int index,
                          struct brume_error *err)
{
    return brume_function_constant(to, 1, err) && take(to, 3, err) &&
           take(to, 4, err) && apply(to, BRUME_OP_ADD, err) &&
           apply(to, BRUME_OP_MIN, err) && take(to, index, err) &&
           apply(to, BRUME_OP_MULTIPLY, err);
}

/* own c + (filter c + transmit) below's own below's c, as if of the whole. */
static bool write_channel(struct brume_function *to, int c,
                          struct brume_error *err)
{
    return write_own_part(to, 0, err) && take(to, c, err) &&
           apply(to, BRUME_OP_MULTIPLY, err) && take(to, c, err) &&
           take(to, 3, err) && apply(to, BRUME_OP_MULTIPLY, err) &&
           take(to, 4, err) && apply(to, BRUME_OP_ADD, err) &&
           write_own_part(to, 5, err) && apply(to, BRUME_OP_MULTIPLY, err) &&
           take(to, 5 + c, err) && apply(to, BRUME_OP_MULTIPLY, err) &&
           apply(to, BRUME_OP_ADD, err) &&
           brume_function_constant(to, 1e-9, err) &&
           brume_function_constant(to, 1, err) && write_through(to, 8, err) &&
           apply(to, BRUME_OP_SUBTRACT, err) && write_through(to, 9, err) &&
           apply(to, BRUME_OP_SUBTRACT, err) && apply(to, BRUME_OP_MAX, err) &&
           apply(to, BRUME_OP_DIVIDE, err);
}

int build_cover(struct parser *parser, struct brume_error *err)
{
    struct builder *builder = parser->builder;
    struct brume_function *to;

    if (builder->cover > 0)
        return builder->cover - 1;
    to = brume_function_new(parser->out->scene, 10, err);
    if (!to)
        return -1;
    for (int c = 0; c < 3; c++)
        write_channel(to, c, err);
    write_through(to, 8, err);
    write_through(to, 9, err);
    builder->cover = brume_add_function(parser->out->scene, to, err) + 1;
    return builder->cover - 1;
}
