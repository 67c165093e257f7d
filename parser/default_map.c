/* default_map.c - the colours of patterns that are given none, as POV-Ray
 * 3.7 prints them for `function { pigment { ... } }`. */
#include "parser/surface.h"

enum { MOST = 8 };

struct default_map {
    int count;
    double place[MOST];
    double color[MOST][5];
};

static const struct default_map gray = {
    2, {0, 1}, {{0, 0, 0, 0, 0}, {1, 1, 1, 0, 0}}};
static const struct default_map agate = {6,
                                         {0, 0.5, 0.5, 0.6, 0.6, 1},
                                         {{1, 1, 1},
                                          {0.95, 0.75, 0.5},
                                          {0.9, 0.7, 0.5},
                                          {0.9, 0.7, 0.4},
                                          {1, 0.7, 0.4},
                                          {0.6, 0.3, 0}}};
static const struct default_map bozo = {8,
                                        {0, 0.4, 0.4, 0.6, 0.6, 0.8, 0.8, 1},
                                        {{1, 1, 1},
                                         {1, 1, 1},
                                         {0, 1, 0},
                                         {0, 1, 0},
                                         {0, 0, 1},
                                         {0, 0, 1},
                                         {1, 0, 0},
                                         {1, 0, 0}}};
static const struct default_map mandel = {
    7,
    {0, 0.001, 0.001, 0.012, 0.015, 0.1, 1},
    {{0, 0, 0},
     {0, 0, 0},
     {0, 1, 1},
     {1, 1, 0},
     {1, 0, 1},
     {0, 1, 1},
     {0, 1, 1}}};
static const struct default_map marble = {
    4,
    {0, 0.9, 0.9, 1},
    {{0.9, 0.8, 0.8}, {0.9, 0.08, 0.08}, {0, 0, 0}, {0, 0, 0}}};
static const struct default_map radial = {
    4, {0, 0.333, 0.666, 1}, {{0, 1, 1}, {1, 1, 0}, {1, 0, 1}, {0, 1, 1}}};
static const struct default_map wood = {4,
                                        {0, 0.6, 0.6, 1},
                                        {{0.666, 0.312, 0.2},
                                         {0.666, 0.312, 0.2},
                                         {0.4, 0.1333, 0.066},
                                         {0.4, 0.1333, 0.066}}};

static const struct default_map *map_of(const struct pattern *pattern)
{
    switch (pattern->kind) {
    case PATTERN_AGATE:
        return &agate;
    case PATTERN_BOZO:
        return &bozo;
    case PATTERN_MANDEL:
        return pattern->magnet ? &gray : &mandel;
    case PATTERN_MARBLE:
        return &marble;
    case PATTERN_RADIAL:
        return &radial;
    case PATTERN_WOOD:
        return &wood;
    default:
        return &gray;
    }
}

struct brume_map surface_default_map(const struct pattern *pattern)
{
    const struct default_map *map = map_of(pattern);

    return (struct brume_map){.count = map->count,
                              .terms = 5,
                              .places = map->place,
                              .values = map->color[0]};
}
