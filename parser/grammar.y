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
#include "parser/formula.h"
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
/* Values are taken apart into registers and put together again by gcc, and
 * each time the processor waits for the parts to reach memory. */
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC optimize("no-tree-sra")
#endif
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
    int count;
    struct data_run data;
}

%token END 0 "the end of the text"

/* Tokens of the expander's own making. */
%token MODE_SCENE MODE_VALUE MODE_STRING MODE_CONDITION MODE_FLOATS
%token MODE_INDEX MODE_DEFAULT
%token BAD "text" MORE
%token <data> DATA "numbers"
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
%token HASH_FOPEN "'#fopen'" HASH_FCLOSE "'#fclose'"
%token HASH_READ "'#read'" HASH_WRITE "'#write'"
%token HASH_DEBUG "'#debug'" HASH_WARNING "'#warning'" HASH_ERROR "'#error'"

%token <value> NUMBER "number" STRING "string"
%token <name> IDENTIFIER "identifier"
%token <name> DOT "component"
%token <value> FLOAT_ID "float identifier" VECTOR_ID "vector identifier"
%token <value> COLOR_ID "color identifier" STRING_ID "string identifier"
%token <value> ARRAY_ID "array identifier" MACRO_ID "macro identifier"
%token <value> NODE_ID "identifier of a statement"
%token <value> FILE_ID "file identifier"
%token <value> FUNCTION_ID "function identifier" SPLINE_ID "spline identifier"

%token <name> NUMBER_FUNCTION "numeric function"
%token <name> STRING_FUNCTION "string function"
%token <name> OBJECT_FUNCTION "object function" TRACE "'trace'"
%token <name> SERIES "'sum' or 'prod'"
%token DEFINED "'defined'" DIMENSIONS "'dimensions'"
%token DIMENSION_SIZE "'dimension_size'"
%token ARRAY "'array'" <name> FUNCTION "'function'" INTERNAL "'internal'"

%token COLOR "'color'" <name> RED "'red'" GREEN "'green'" BLUE "'blue'"
%token <name> FILTER "'filter'" TRANSMIT "'transmit'" RGB "color keyword"

%token ';'
%token LESS_EQUAL "'<='" GREATER_EQUAL "'>='" NOT_EQUAL "'!='"

/* Every word of a statement: what it may hold, and where, is in the builder's
 * tables. */
%token <name> WORD "keyword" CALLED "'pwr' or 'xyz'" TEXTURE "'texture'"

/* An operand ends only where no operator follows: LOW is below them all. */
%precedence LOW
%precedence '{' TEXTURE
%precedence RED GREEN BLUE FILTER TRANSMIT
%left '+' '-'
%left '*' '/'
%precedence SIGN
%precedence '('
%precedence DOT

%nterm <value> rvalue expr float full logic relation
%nterm <value> string array list function
%nterm <color> color_words color_head color_item
%nterm <count> components arguments sizes items relop

%nterm <value> operand node layers texture subject code

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
  | default_open contents '}'
        { build_close(parser, @3); YYACCEPT; }
  ;

value_open:
    MODE_VALUE
        { build_suspend(parser); }
  ;

default_open:
    MODE_DEFAULT '{'
        { build_open_default(parser, @1); }
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
  | layers %prec LOW
  | code
  | NODE_ID
  | FUNCTION_ID %prec LOW
  | SPLINE_ID %prec LOW
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
        { $$ = eval_negate(parser, &$2, @1); }
  | '!' expr %prec SIGN
        { $$ = eval_not(parser, &$2, @1); }
  | color_words %prec LOW
        { $$ = eval_color(&$1); }
  ;

components:
    component
        { $$ = 1; }
  | components component
        { $$ = $1 + 1; }
  | components ',' component
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
  | FUNCTION_ID '(' arguments ')'
        { $$ = formula_call(parser, &$1, $3, @1); }
  | SPLINE_ID '(' arguments ')'
        { $$ = build_spline_value(parser, &$1, $3, NULL, @1); }
  | SPLINE_ID '(' arguments comma WORD ')'
        { $$ = build_spline_value(parser, &$1, $3, $5, @1); }
  | SERIES '(' want_name IDENTIFIER comma operand comma operand comma
    series_open full ')'
        { $$ = formula_series_close(parser, $1, &$6, &$8, &$11, @1); }
  | OBJECT_FUNCTION '(' subject ')'
        { $$ = build_object_value(parser, $1, &$3, NULL, @1); }
  | OBJECT_FUNCTION '(' subject comma operand ')'
        { $$ = build_object_value(parser, $1, &$3, &$5, @1); }
  | TRACE '(' subject comma operand comma operand ')'
        { $$ = build_trace(parser, &$3, &$5, &$7, NULL, @1); }
  | TRACE '(' subject comma operand comma operand ',' want_name IDENTIFIER ')'
        { $$ = build_trace(parser, &$3, &$5, &$7, $10, @1); }
  | DIMENSIONS '(' ARRAY_ID ')'
        { $$ = value_float($3.array->rank); }
  | DIMENSION_SIZE '(' ARRAY_ID comma float ')'
        { $$ = eval_dimension_size(parser, &$3, &$5, @5); }
  ;

operand:
    expr %prec LOW
  ;

subject:
    NODE_ID
  | node
  ;

/* The variable of a sum is a name of a formula while its term is read. */
series_open:
    %empty
        { formula_series_open(parser, $<name>-5); }
  ;

arguments:
    argument
        { $$ = 1; }
  | arguments argument
        { $$ = $1 + 1; }
  | arguments ',' argument
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
  | COLOR_ID
        { $$ = eval_color_all(parser, &$1, @1); }
  | RGB expr %prec LOW
        { $$ = eval_color_rgb(parser, $1, &$2, @2); }
  | COLOR expr %prec LOW
        { $$ = eval_color_all(parser, &$2, @2); }
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

/* ---- functions: while the body of one is read, its parameters are names of
 * formulas, so that the rules above make a formula of it ------------------ */

code:
    FUNCTION body_open body '}'
        { $$ = formula_close(parser); }
  | FUNCTION parameters body_open body '}'
        { $$ = formula_close(parser); }
  | FUNCTION grid body_open body '}'
        { $$ = formula_close(parser); }
  ;

parameters:
    '(' want_name names ')'
        { formula_parameters(parser); }
  ;

want_name:
    %empty
        { expander_want_name(parser, true); }
  ;

names:
    IDENTIFIER
        { formula_parameter(parser, $1); }
  | names comma IDENTIFIER
        { formula_parameter(parser, $3); }
  ;

/* Columns and rows of a height field. */
grid:
    grid_size comma grid_size
        { formula_grid(parser, @1); }
  ;

grid_size:
    NUMBER
        { eval_push(parser, &$1); }
  | FLOAT_ID
        { eval_push(parser, &$1); }
  ;

body_open:
    '{'
        { formula_open(parser); }
  ;

body:
    full
        { formula_body(parser, &$1, @1); }
  | INTERNAL '(' float ')'
        { formula_internal(parser, &$3, @1); }
  | WORD inner_open contents '}'
        { formula_statement(parser, @4); }
  ;

/* Inside of `function { pigment { ... } }` x is a vector again. */
inner_open:
    '{'
        {
            formula_suspend(parser);
            build_suspend(parser);
            build_open(parser, $<name>0, @0);
        }
  ;

/* ---- statements: opened, filled and closed in the builder -------------- */

scene:
    %empty
  | scene node
        { build_place(parser, &$2, @2); }
  | scene NODE_ID
        { build_place(parser, &$2, @2); }
  | scene ';'
  ;

node:
    WORD open contents '}'
        { $$ = build_close(parser, @4); }
  ;

/* The braces of a statement, of which the keyword stands before them. */
open:
    '{'
        { build_open(parser, $<name>0, @0); }
  ;

texture:
    TEXTURE open contents '}'
        { $$ = build_close(parser, @4); }
  ;

/* Textures in a row are layers of one. */
layers:
    texture
  | layers texture
        { $$ = build_layer(parser, &$1, &$2, @2); }
  ;

/* What stands in a statement, one thing after the other: a word, to which the
 * numbers and strings after it go as far as its row in the tables takes them;
 * values; entries of maps. A comma may stand behind each. */
contents:
    %empty
  | contents content
  | contents content ','
  ;

content:
    expr %prec LOW
        { build_argument(parser, &$1, @1); }
  | DATA
        { eval_data(parser, $1, @1); }
  | string
        { build_argument(parser, &$1, @1); }
  | WORD
        { build_word(parser, $1, @1); }
  | CALLED '(' arguments ')'
        { build_called(parser, $1, $3, NULL, @1); }
  | CALLED '(' arguments ')' ':' expr %prec LOW
        { build_called(parser, $1, $3, &$6, @1); }
  | node
        { build_apply(parser, &$1, @1); }
  | texture
        { build_apply(parser, &$1, @1); }
  | code
        { build_apply(parser, &$1, @1); }
  | NODE_ID
        { build_apply(parser, &$1, @1); }
  | SPLINE_ID %prec LOW
        { build_apply(parser, &$1, @1); }
  | entry_open contents ']'
        { build_close_entry(parser, @3); }
  ;

entry_open:
    '['
        { build_open_entry(parser, @1); }
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
