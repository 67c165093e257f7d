/* grammar.y - tokens to calls of the evaluator and the builder: rules only.
 *
 * The parser is pushed by the expander. One grammar serves the scene and the
 * values inside of directives: the first token says which (TOK_MODE_...). */
%require "3.8"
%define api.pure full
%define api.push-pull push
%define api.prefix {scene_yy}
%define api.token.prefix {TOK_}
%define api.location.type {struct location}
%define parse.error custom
%define parse.lac full
%locations
%expect 0
%parse-param {struct parser *parser}

%code requires {
#include "parser/eval.h"
#include "parser/build.h"
#include "parser/token.h"
#include "parser/value.h"

struct scene_yypstate;

#define YYLLOC_DEFAULT(current, rhs, n) \
    ((current) = (n) ? YYRHSLOC(rhs, 1) : YYRHSLOC(rhs, 0))
}

%code provides {
/* The name of a token as messages print it; quoted where it is text. */
const char *grammar_token_name(int token);
/* Whether the parser, which is at the start of a token, would take this one.
 * Nothing is changed. */
bool grammar_accepts(struct scene_yypstate *state, int token);
}

%code {
#include "parser/expander.h"
#include "parser/report.h"

/* A deeper nesting of brackets is refused. */
#define YYMAXDEPTH GRAMMAR_DEPTH
/* Values inside of directives are short, and there may be many parsers. */
#define YYINITDEPTH 40
enum { GRAMMAR_DEPTH = 1000000 };

static void scene_yyerror(const struct location *at, struct parser *parser,
                          const char *text);
}

%union {
    struct value value;
    struct name *name;
    struct color color;
    struct build_file file;
    int count;
}

%token END 0 "the end of the text"

/* Tokens of the expander's own making. */
%token MODE_SCENE MODE_VALUE MODE_STRING MODE_CONDITION MODE_FLOATS
%token MODE_INDEX MODE_DEFAULT
%token BAD "text"
%token <name> UNSUPPORTED "word"

/* Directives: they never reach the grammar. */
%token HASH_IF "'#if'" HASH_IFDEF "'#ifdef'" HASH_IFNDEF "'#ifndef'"
%token HASH_ELSE "'#else'" HASH_ELSEIF "'#elseif'" HASH_END "'#end'"
%token HASH_SWITCH "'#switch'" HASH_CASE "'#case'" HASH_RANGE "'#range'"
%token HASH_WHILE "'#while'" HASH_FOR "'#for'" HASH_BREAK "'#break'"
%token HASH_MACRO "'#macro'"
%token HASH_DECLARE "'#declare'" HASH_LOCAL "'#local'" HASH_UNDEF "'#undef'"
%token HASH_INCLUDE "'#include'" HASH_VERSION "'#version'"
%token HASH_DEFAULT "'#default'" HASH_ALONE "'#'"
%token HASH_DEBUG "'#debug'" HASH_WARNING "'#warning'" HASH_ERROR "'#error'"

%token <value> NUMBER "number" STRING "string"
%token <name> IDENTIFIER "identifier"
%token <name> DOT "component"
%token <value> FLOAT_ID "float identifier" VECTOR_ID "vector identifier"
%token <value> COLOR_ID "color identifier" STRING_ID "string identifier"
%token <value> ARRAY_ID "array identifier" MACRO_ID "macro identifier"
%token <value> OBJECT_ID "object identifier" TEXTURE_ID "texture identifier"
%token <value> PIGMENT_ID "pigment identifier" NORMAL_ID "normal identifier"
%token <value> FINISH_ID "finish identifier" MAP_ID "color_map identifier"
%token <value> MATERIAL_ID "material identifier"
%token <value> INTERIOR_ID "interior identifier" MEDIA_ID "media identifier"
%token <value> DENSITY_ID "density identifier"
%token <value> TRANSFORM_ID "transform identifier"
%token <value> CAMERA_ID "camera identifier"
%token <value> LIGHT_ID "light_source identifier"

%token <name> NUMBER_FUNCTION "numeric function"
%token <name> STRING_FUNCTION "string function"
%token DEFINED "'defined'" DIMENSIONS "'dimensions'"
%token DIMENSION_SIZE "'dimension_size'"
%token ARRAY "'array'"

%token COLOR "'color'" RED "'red'" GREEN "'green'" BLUE "'blue'"
%token FILTER "'filter'" TRANSMIT "'transmit'"
%token <name> RGB "color keyword"

%token ';'
%token LESS_EQUAL "'<='" GREATER_EQUAL "'>='" NOT_EQUAL "'!='"

/* Statements and their words. Words that are used alike share a token. */
%token <name> CAMERA "'camera'" LIGHT_SOURCE "'light_source'"
%token <name> BACKGROUND "'background'" GLOBAL_SETTINGS "'global_settings'"
%token <name> SHAPE "shape" CYLINDER "'cylinder'"
%token <name> MESH "'mesh'" MESH2 "'mesh2'" UNION "'union'"
%token <name> OBJECT "'object'" MESH_LIST "list of a mesh2"
%token <name> TEXTURE "'texture'" PIGMENT "'pigment'" FINISH "'finish'"
%token <name> MATERIAL "'material'" INTERIOR "'interior'" MEDIA "'media'"
%token <name> SCATTERING "'scattering'" DENSITY "'density'"
%token <name> DENSITY_FILE "'density_file'" FIRE "'fire'"
%token <name> FIRE_FIELD "'temperature' or 'amount'"
%token <name> TRANSFORM "'transform'" MATRIX "'matrix'"
%token <name> TRANSPORT "'transport'"
%token <name> MOVE "transformation" INVERSE "'inverse'"
%token <name> CAMERA_TYPE "camera type" CAMERA_ITEM "camera item"
%token <name> UP "'up'" RADIUS "'radius'" UV_VECTORS "'uv_vectors'"
%token <name> LIGHT_TYPE "'spotlight'" LIGHT_ITEM "light item"
%token <name> LIGHT_SWITCH "'media_interaction'"
%token <name> OBJECT_WORD "object modifier" OBJECT_SWITCH "'hollow'"
%token <name> MESH_FILE "'ply' or 'obj'" INSIDE_VECTOR "'inside_vector'"
%token <name> CHECKER "'checker'" QUICK_COLOR "'quick_color'"
%token <name> FINISH_ITEM "finish item" METALLIC "'metallic'"
%token <name> EMISSION "'emission'" ABSORPTION "'absorption'"
%token <name> MEDIA_HINT "sampling hint" SAMPLES "'samples'"
%token <name> SCATTERING_ITEM "scattering item"
%token <name> FILE_FORMAT "format of a density file"
%token <name> INTERPOLATE "'interpolate'" FIT "'fit'"
%token <name> KELVIN "'kelvin'" FIRE_ITEM "fire item"
%token <name> FIRE_CHOICE "'brightness', 'coupling' or 'preset'"
%token <name> GLOBAL_ITEM "global setting"
%token <name> GLOBAL_CHOICE "'integrator' or 'light_units'"
%token <name> SURFACES "'surfaces'" CHOICE "choice"
%token <name> ENVIRONMENT "'environment'" LATER "word to come"

/* An operand ends only where no operator follows: LOW is below them all. */
%precedence LOW
%precedence '{'
%precedence RED GREEN BLUE FILTER TRANSMIT
%left '+' '-'
%left '*' '/'
%precedence SIGN
%precedence DOT

%nterm <value> rvalue expr float full logic relation
%nterm <value> string array list function
%nterm <color> color_words color_head color_item
%nterm <count> components arguments sizes items relop

%nterm <value> node placed object shape member named light camera part
%nterm <value> surface texture texture_item pigment finish material
%nterm <value> material_item interior media density transform
%nterm <name> camera_word light_word object_word list_word finish_word
%nterm <name> media_word shape_word choice
%nterm <file> density_file

%%

start:
    MODE_SCENE scene
  | value_open rvalue
        { build_resume(parser); expander_result(parser, &$2); }
  | MODE_STRING string
        { expander_result(parser, &$2); YYACCEPT; }
  | MODE_CONDITION '(' full ')'
        { expander_result(parser, &$3); YYACCEPT; }
  | MODE_FLOATS arguments ')'
        { expander_count(parser, $2); YYACCEPT; }
  | MODE_INDEX '[' float ']'
        { expander_result(parser, &$3); YYACCEPT; }
  | default_open defaults '}'
        { build_close(parser, @3); YYACCEPT; }
  ;

value_open:
    MODE_VALUE
        { build_suspend(parser); }
  ;

default_open:
    MODE_DEFAULT '{'
        { build_open(parser, "#default", @1); }
  ;

/* ---- values ------------------------------------------------------------ */

/* What can be declared. */
rvalue:
    expr %prec LOW
  | string
  | array
  | ARRAY_ID
        { $$ = eval_array_copy(parser, &$1); }
  | node
  ;

/* Where a float is wanted. */
float:
    expr %prec LOW
        { $$ = eval_float(parser, &$1, @1); }
  ;

comma:
    %empty
  | ','
  ;

expr:
    NUMBER
  | FLOAT_ID
  | VECTOR_ID
  | COLOR_ID
  | '<' components comma '>'
        { $$ = eval_components(parser, $2, @1); }
  | '(' full ')'
        { $$ = $2; }
  | function
  | expr DOT
        { $$ = eval_component(parser, &$1, $2, @2); }
  | expr '+' expr
        { $$ = eval_binary(parser, VALUE_ADD, &$1, &$3, @2); }
  | expr '-' expr
        { $$ = eval_binary(parser, VALUE_SUBTRACT, &$1, &$3, @2); }
  | expr '*' expr
        { $$ = eval_binary(parser, VALUE_MULTIPLY, &$1, &$3, @2); }
  | expr '/' expr
        { $$ = eval_binary(parser, VALUE_DIVIDE, &$1, &$3, @2); }
  | '+' expr %prec SIGN
        { $$ = $2; }
  | '-' expr %prec SIGN
        { $$ = value_negate($2); }
  | '!' expr %prec SIGN
        { $$ = value_not($2); }
  | color_words %prec LOW
        { $$ = eval_color(&$1); }
  ;

components:
    component
        { $$ = 1; }
  | components comma component
        { $$ = $1 + 1; }
  ;

component:
    expr %prec LOW
        { eval_push(parser, &$1); }
  ;

/* Relations and logic stand in parentheses only: elsewhere '<' is a vector. */
full:
    logic
  | logic '?' full ':' full
        { $$ = eval_choice(parser, &$1, &$3, &$5, @2); }
  ;

logic:
    relation
  | logic '&' relation
        { $$ = eval_binary(parser, VALUE_AND, &$1, &$3, @2); }
  | logic '|' relation
        { $$ = eval_binary(parser, VALUE_OR, &$1, &$3, @2); }
  ;

relation:
    expr
  | relation relop expr
        { $$ = eval_binary(parser, $2, &$1, &$3, @2); }
  | string relop string
        { $$ = eval_compare($2, &$1, &$3); }
  ;

relop:
    '<'             { $$ = VALUE_LESS; }
  | LESS_EQUAL      { $$ = VALUE_LESS_EQUAL; }
  | '='             { $$ = VALUE_EQUAL; }
  | NOT_EQUAL       { $$ = VALUE_NOT_EQUAL; }
  | GREATER_EQUAL   { $$ = VALUE_GREATER_EQUAL; }
  | '>'             { $$ = VALUE_GREATER; }
  ;

function:
    NUMBER_FUNCTION '(' arguments ')'
        { $$ = eval_call(parser, $1, $3, @1); }
  | DIMENSIONS '(' ARRAY_ID ')'
        { $$ = value_float($3.array->rank); }
  | DIMENSION_SIZE '(' ARRAY_ID comma float ')'
        { $$ = eval_dimension_size(parser, &$3, &$5, @5); }
  ;

arguments:
    argument
        { $$ = 1; }
  | arguments comma argument
        { $$ = $1 + 1; }
  ;

argument:
    expr %prec LOW
        { eval_push(parser, &$1); }
  | string
        { eval_push(parser, &$1); }
  ;

string:
    STRING
  | STRING_ID
  | STRING_FUNCTION '(' arguments ')'
        { $$ = eval_call(parser, $1, $3, @1); }
  ;

/* ---- colors ------------------------------------------------------------ */

color_words:
    color_head
  | color_words color_item
        { $$ = eval_color_join(&$1, &$2); }
  ;

color_head:
    color_item
  | RGB expr %prec LOW
        { $$ = eval_color_rgb(parser, $1, &$2, @2); }
  | COLOR expr %prec LOW
        { $$ = eval_color_all(&$2); }
  ;

color_item:
    RED expr %prec LOW
        { $$ = eval_color_term(parser, 0, &$2, @2); }
  | GREEN expr %prec LOW
        { $$ = eval_color_term(parser, 1, &$2, @2); }
  | BLUE expr %prec LOW
        { $$ = eval_color_term(parser, 2, &$2, @2); }
  | FILTER expr %prec LOW
        { $$ = eval_color_term(parser, 3, &$2, @2); }
  | TRANSMIT expr %prec LOW
        { $$ = eval_color_term(parser, 4, &$2, @2); }
  ;

/* ---- arrays: their items are indexed by the expander ------------------- */

array:
    ARRAY sizes %prec LOW
        { $$ = eval_array(parser, $2, NULL, @1); }
  | ARRAY sizes list
        { $$ = eval_array(parser, $2, &$3, @1); }
  ;

sizes:
    size
        { $$ = 1; }
  | sizes size
        { $$ = $1 + 1; }
  ;

size:
    '[' float ']'
        { eval_push(parser, &$2); }
  ;

list:
    '{' items comma '}'
        { $$ = eval_list(parser, $2); }
  ;

items:
    item
        { $$ = 1; }
  | items comma item
        { $$ = $1 + 1; }
  ;

item:
    rvalue
        { eval_push(parser, &$1); }
  | list
        { eval_push(parser, &$1); }
  ;

/* ---- statements: opened, filled and closed in the builder -------------- */

scene:
    %empty
  | scene placed                    { build_place(parser, &$2, @2); }
  | scene BACKGROUND open numbers '}' { build_close(parser, @5); }
  | scene BACKGROUND open LATER
        { build_later(parser, $4, @4); }
  | scene GLOBAL_SETTINGS open global_items '}' { build_close(parser, @5); }
  ;

placed:
    object | light | camera | media
  ;

/* Values that can be declared, besides numbers, strings and arrays. */
node:
    placed | part | density | transform
  | OBJECT_ID | LIGHT_ID | CAMERA_ID | TEXTURE_ID | PIGMENT_ID | FINISH_ID
  | MATERIAL_ID | INTERIOR_ID | MEDIA_ID | DENSITY_ID | TRANSFORM_ID
  ;

/* The braces of a statement, of which the keyword stands before them. */
open:
    '{'                             { build_open(parser, $<name>0->text, @0); }
  ;

/* Numbers that stand before the modifiers of a statement. */
numbers:
    number
  | numbers ',' number
  | numbers number
  ;

number:
    expr %prec LOW                  { build_argument(parser, &$1, @1); }
  ;

/* ---- transformations --------------------------------------------------- */

transformation:
    MOVE expr %prec LOW             { build_move(parser, $1->text, &$2, @2); }
  | MATRIX '<' components '>'
        { build_matrix(parser, eval_pop(parser, $3), $3, @1); }
  | TRANSFORM TRANSFORM_ID          { build_apply(parser, &$2, @2); }
  | transform                       { build_apply(parser, &$1, @1); }
  ;

transform:
    TRANSFORM open transform_items '}' { $$ = build_close(parser, @4); }
  ;

transform_items:
    %empty
  | transform_items transformation
  | transform_items TRANSFORM_ID    { build_apply(parser, &$2, @2); }
  | transform_items INVERSE         { build_word(parser, $2, @2); }
  ;

/* ---- camera and lights ------------------------------------------------- */

camera:
    CAMERA open camera_items '}'    { $$ = build_close(parser, @4); }
  ;

camera_items:
    %empty
  | camera_items transformation
  | camera_items CAMERA_ID          { build_apply(parser, &$2, @2); }
  | camera_items CAMERA_TYPE        { build_word(parser, $2, @2); }
  | camera_items CYLINDER           { build_later(parser, $2, @2); }
  | camera_items camera_word expr %prec LOW
        { build_set(parser, $2, @2, &$3, 1, @3); }
  ;

camera_word:
    CAMERA_ITEM | UP
  ;

light:
    LIGHT_SOURCE open light_start light_items '}'
        { $$ = build_close(parser, @5); }
  ;

light_start:
    numbers
  | LIGHT_ID                        { build_apply(parser, &$1, @1); }
  ;

light_items:
    %empty
  | light_items transformation
  | light_items LIGHT_TYPE          { build_word(parser, $2, @2); }
  | light_items CYLINDER            { build_later(parser, $2, @2); }
  | light_items light_word expr %prec LOW
        { build_set(parser, $2, @2, &$3, 1, @3); }
  | light_items LIGHT_SWITCH        { build_word(parser, $2, @2); }
  | light_items LIGHT_SWITCH expr %prec LOW
        { build_set(parser, $2, @2, &$3, 1, @3); }
  ;

light_word:
    LIGHT_ITEM | RADIUS
  ;

/* ---- objects ----------------------------------------------------------- */

object:
    shape
  | MESH open mesh_items '}'        { $$ = build_close(parser, @4); }
  | MESH2 open mesh2_items '}'      { $$ = build_close(parser, @4); }
  | UNION open union_items '}'      { $$ = build_close(parser, @4); }
  | OBJECT open object_items '}'    { $$ = build_close(parser, @4); }
  ;

shape:
    shape_word open numbers modifiers '}'
        { $$ = build_close(parser, @5); }
  ;

shape_word:
    SHAPE | CYLINDER
  ;

modifiers:
    %empty
  | modifiers modifier
  ;

modifier:
    part                            { build_apply(parser, &$1, @1); }
  | object_word                     { build_word(parser, $1, @1); }
  | OBJECT_SWITCH                   { build_word(parser, $1, @1); }
  | OBJECT_SWITCH expr %prec LOW    { build_set(parser, $1, @1, &$2, 1, @2); }
  | INSIDE_VECTOR expr %prec LOW    { build_set(parser, $1, @1, &$2, 1, @2); }
  | UV_VECTORS components
        { build_uv_vectors(parser, eval_pop(parser, $2), $2, @1); }
  | transformation
  ;

object_word:
    OBJECT_WORD | INVERSE
  ;

part:
    texture | pigment | finish | material | interior
  ;

mesh_items:
    %empty
  | mesh_items modifier
  | mesh_items shape                { build_apply(parser, &$2, @2); }
  | mesh_items MESH_FILE string
        { build_mesh_file(parser, $2->text, $3.string, @3); }
  ;

mesh2_items:
    %empty
  | mesh2_items modifier
  | mesh2_items list_word open numbers '}' { build_close(parser, @5); }
  | mesh2_items list_word open numbers ',' '}' { build_close(parser, @6); }
  ;

list_word:
    MESH_LIST | UV_VECTORS
  ;

union_items:
    %empty
  | union_items modifier
  | union_items member              { build_apply(parser, &$2, @2); }
  ;

object_items:
    %empty
  | object_items modifier
  | object_items named              { build_apply(parser, &$2, @2); }
  ;

member:
    object | light
  ;

named:
    member | OBJECT_ID | LIGHT_ID
  ;

/* ---- surfaces ---------------------------------------------------------- */

surface:
    texture | pigment | finish
  ;

defaults:
    %empty
  | defaults surface                { build_apply(parser, &$2, @2); }
  ;

texture:
    TEXTURE open texture_items '}'  { $$ = build_close(parser, @4); }
  ;

texture_items:
    %empty
  | texture_items transformation
  | texture_items texture_item      { build_apply(parser, &$2, @2); }
  ;

texture_item:
    TEXTURE_ID | PIGMENT_ID | FINISH_ID | pigment | finish
  ;

pigment:
    PIGMENT open pigment_items '}'  { $$ = build_close(parser, @4); }
  ;

pigment_items:
    %empty
  | pigment_items transformation
  | pigment_items colors
  | pigment_items density_file %prec LOW
        { build_density_file(parser, &$2); }
  | pigment_items PIGMENT_ID        { build_apply(parser, &$2, @2); }
  | pigment_items CHECKER           { build_word(parser, $2, @2); }
  | pigment_items QUICK_COLOR expr %prec LOW
        { build_set(parser, $2, @2, &$3, 1, @3); }
  ;

colors:
    number
  | colors ',' number
  ;

finish:
    FINISH open finish_items '}'    { $$ = build_close(parser, @4); }
  ;

finish_items:
    %empty
  | finish_items FINISH_ID          { build_apply(parser, &$2, @2); }
  | finish_items finish_word expr %prec LOW
        { build_set(parser, $2, @2, &$3, 1, @3); }
  | finish_items METALLIC           { build_word(parser, $2, @2); }
  | finish_items METALLIC expr %prec LOW
        { build_set(parser, $2, @2, &$3, 1, @3); }
  ;

finish_word:
    FINISH_ITEM | EMISSION
  ;

material:
    MATERIAL open material_items '}' { $$ = build_close(parser, @4); }
  ;

material_items:
    %empty
  | material_items transformation
  | material_items material_item    { build_apply(parser, &$2, @2); }
  ;

material_item:
    MATERIAL_ID | texture | interior
  ;

/* ---- interior and media ------------------------------------------------ */

interior:
    INTERIOR open interior_items '}' { $$ = build_close(parser, @4); }
  ;

interior_items:
    %empty
  | interior_items INTERIOR_ID      { build_apply(parser, &$2, @2); }
  | interior_items media            { build_apply(parser, &$2, @2); }
  ;

media:
    MEDIA open media_items '}'      { $$ = build_close(parser, @4); }
  ;

media_items:
    %empty
  | media_items transformation
  | media_items MEDIA_ID            { build_apply(parser, &$2, @2); }
  | media_items media_word expr %prec LOW
        { build_set(parser, $2, @2, &$3, 1, @3); }
  | media_items SAMPLES components
        { build_set(parser, $2, @2, eval_pop(parser, $3), $3, @3); }
  | media_items SCATTERING open numbers scattering_items '}'
        { build_close(parser, @6); }
  | media_items density             { build_apply(parser, &$2, @2); }
  | media_items FIRE open fire_items '}' { build_close(parser, @5); }
  ;

media_word:
    ABSORPTION | EMISSION | MEDIA_HINT
  ;

scattering_items:
    %empty
  | scattering_items SCATTERING_ITEM expr %prec LOW
        { build_set(parser, $2, @2, &$3, 1, @3); }
  ;

density:
    DENSITY open density_items '}'  { $$ = build_close(parser, @4); }
  ;

density_items:
    %empty
  | density_items transformation
  | density_items number
  | density_items DENSITY_ID        { build_apply(parser, &$2, @2); }
  | density_items density_file %prec LOW { build_density_file(parser, &$2); }
  ;

density_file:
    DENSITY_FILE FILE_FORMAT string
        { $$ = build_file_named($2->text, $3.string, @3); }
  | density_file string             { $$ = $1; $$.grid = $2.string; }
  | density_file INTERPOLATE expr %prec LOW
        { $$ = $1; build_file_interpolate(parser, &$$, &$3, @3); }
  | density_file FIT                { $$ = $1; $$.fit = true; }
  | density_file UP expr %prec LOW
        { $$ = $1; build_file_up(parser, &$$, &$3, @3); }
  ;

fire_items:
    %empty
  | fire_items transformation
  | fire_items FIRE_FIELD open density_items '}' { build_close(parser, @5); }
  | fire_items KELVIN components
        { build_set(parser, $2, @2, eval_pop(parser, $3), $3, @3); }
  | fire_items FIRE_ITEM expr %prec LOW
        { build_set(parser, $2, @2, &$3, 1, @3); }
  | fire_items FIRE_CHOICE choice   { build_choose(parser, $2, $3, @3); }
  ;

choice:
    CHOICE | ABSORPTION
  ;

/* ---- global_settings --------------------------------------------------- */

global_items:
    %empty
  | global_items GLOBAL_ITEM expr %prec LOW
        { build_set(parser, $2, @2, &$3, 1, @3); }
  | global_items GLOBAL_CHOICE choice
        { build_choose(parser, $2, $3, @3); }
  | global_items LATER              { build_later(parser, $2, @2); }
  | global_items TRANSPORT open transport_items '}' { build_close(parser, @5); }
  ;

transport_items:
    %empty
  | transport_items MEDIA choice { build_choose(parser, $2, $3, @3); }
  | transport_items SURFACES choice { build_choose(parser, $2, $3, @3); }
  | transport_items ENVIRONMENT expr %prec LOW
        { build_set(parser, $2, @2, &$3, 1, @3); }
  ;

%%

const char *grammar_token_name(int token)
{
    return yysymbol_name(YYTRANSLATE(token));
}

/* The exploratory parse that LAC makes for each token anyway (Denny, "PSLR(1)"
 * thesis, 2010): yy_lac is bison's own function, and gives 0 for a token that
 * can be shifted or that ends the text. */
bool grammar_accepts(struct scene_yypstate *state, int token)
{
    return yy_lac(state->yyesa, &state->yyes, &state->yyes_capacity,
                  state->yyssp, YYTRANSLATE(token)) == 0;
}

/* The token kind of a symbol, which bison does not keep. */
static int token_of(yysymbol_kind_t symbol)
{
    int token = 0;
    while (token < YYMAXUTOK && YYTRANSLATE(token) != symbol) {
        token++;
    }
    return token;
}

static int yyreport_syntax_error(const yypcontext_t *context,
                                 struct parser *parser)
{
    yysymbol_kind_t symbol[YYNTOKENS];
    int expected[YYNTOKENS];
    int count = yypcontext_expected_tokens(context, symbol, YYNTOKENS);
    for (int i = 0; i < count; i++) {
        expected[i] = token_of(symbol[i]);
    }
    report_unexpected(parser, *yypcontext_location(context),
                      token_of(yypcontext_token(context)), expected,
                      count);
    return 0;
}

/* Syntax errors are reported above; what comes here is a stack that would
 * grow over YYMAXDEPTH, or that there is no memory for. */
static void scene_yyerror(const struct location *at, struct parser *parser,
                          const char *text)
{
    (void)text;
    report_exhausted(parser, *at, GRAMMAR_DEPTH);
}
