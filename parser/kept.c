#include "parser/kept.h"
#include "lib/memory.h"
#include "lib/mesh.h"
#include "lib/stamp.h"
#include "parser/reader.h"
#include <stdlib.h>
#include <string.h>

/* ---- texts -------------------------------------------------------------- */

static void free_chunk(struct chunk *chunk)
{
    struct kept_mesh *mesh = chunk->mesh;
    while (mesh) {
        struct kept_mesh *next = mesh->next;
        mesh_free(mesh->mesh);
        free(mesh);
        mesh = next;
    }
    free(chunk->token);
    free(chunk);
}

static void free_text(struct kept_text *text)
{
    struct chunk *chunk = text->chunk;
    while (chunk) {
        struct chunk *after = chunk->after;
        free_chunk(chunk);
        chunk = after;
    }
    arena_release(&text->arena);
    free(text->text);
    free(text->path);
    free(text);
}

/* Drops those that are not used, or not of use. */
static void drop(struct kept *kept, bool all)
{
    struct kept_text **at = &kept->text;
    while (*at) {
        struct kept_text *text = *at;
        if (!all && text->used && text->scanned) {
            at = &text->next;
            continue;
        }
        *at = text->next;
        free_text(text);
    }
}

void kept_release(struct kept *kept)
{
    drop(kept, true);
    arena_release(&kept->arena);
}

void kept_begin(struct kept *kept)
{
    for (struct kept_text *text = kept->text; text; text = text->next)
        text->used = false;
}

void kept_end(struct kept *kept)
{
    drop(kept, false);
}

struct kept_text *kept_find(struct kept *kept, const char *path,
                            const struct stat *now)
{
    struct kept_text *text = kept->text;
    while (text && !(text->path && strcmp(text->path, path) == 0 &&
                     stamp_is_same(&text->was, now)))
        text = text->next;
    if (text)
        text->used = true;
    return text;
}

struct kept_text *kept_find_given(struct kept *kept, const char *given)
{
    struct kept_text *text = kept->text;
    while (text && text->given != given)
        text = text->next;
    if (text)
        text->used = true;
    return text;
}

struct kept_text *kept_add(struct kept *kept, const char *path,
                           const struct stat *was, const char *given,
                           char *text, size_t length, size_t room)
{
    struct kept_text *out = memory_new(1, sizeof *out, NULL);
    if (!out)
        return NULL;
    *out = (struct kept_text){.next = kept->text,
                              .path = path ? strdup(path) : NULL,
                              .given = given,
                              .text = text,
                              .length = length,
                              .room = room,
                              .bytes = room,
                              .used = true};
    if (path && !out->path) {
        free(out);
        return NULL;
    }
    if (was)
        out->was = *was;
    kept->text = out;
    return out;
}

/* ---- tokens ------------------------------------------------------------- */

struct chunk *kept_chunk(struct kept_text *text, struct chunk *last)
{
    struct chunk *chunk = memory_new(1, sizeof *chunk, NULL);
    if (!chunk)
        return NULL;
    chunk->text = text->text;
    chunk->kept = true;
    chunk->of = text;
    *(last ? &last->after : &text->chunk) = chunk;
    return chunk;
}

void kept_label(struct kept_text *text, uint32_t source)
{
    struct chunk *chunk = text->source == source ? NULL : text->chunk;
    for (; chunk; chunk = chunk->after)
        for (size_t i = 0; i < chunk->tokens; i++)
            chunk->token[i].source = (uint16_t)source;
    text->source = source;
}

/* ---- meshes ------------------------------------------------------------- */

/* They are asked for in their order. */
struct kept_mesh *kept_mesh_find(struct chunk *chunk, size_t first)
{
    struct kept_mesh *from = chunk->mesh_hint, *mesh = from;
    while (mesh && mesh->first != first)
        mesh = mesh->next;
    if (!mesh)
        mesh = chunk->mesh;
    while (mesh && mesh != from && mesh->first != first)
        mesh = mesh->next;
    if (!mesh || mesh->first != first)
        return NULL;
    chunk->mesh_hint = mesh->next ? mesh->next : chunk->mesh;
    return mesh;
}

struct kept_mesh *kept_mesh_add(struct chunk *chunk, size_t first)
{
    struct kept_mesh *mesh = memory_new(1, sizeof *mesh, NULL);
    if (!mesh)
        return NULL;
    mesh->first = first;
    if (chunk->mesh_last)
        chunk->mesh_last->next = mesh;
    else
        chunk->mesh = mesh;
    chunk->mesh_last = mesh;
    return mesh;
}
