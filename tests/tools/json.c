/* json.c - a value of a JSON file, for the scripts of the suite.
 *
 *   json FILE [KEY]...      a key of an object, or an index of an array
 *
 * Status 1: not JSON, or no such value; 2: usage. */
#include <stdio.h>
#include <stdlib.h>
#include <jansson.h>

int main(int argc, char **argv)
{
    if (argc < 2) {
        fprintf(stderr, "usage: json FILE [KEY]...\n");
        return 2;
    }
    json_error_t error;
    json_t *root = json_load_file(argv[1], 0, &error);
    if (!root)
        fprintf(stderr, "%s:%d: %s\n", argv[1], error.line, error.text);
    const json_t *value = root;
    for (int i = 2; i < argc && value; i++)
        value = json_is_array(value)
                    ? json_array_get(value, strtoul(argv[i], NULL, 10))
                    : json_object_get(value, argv[i]);
    char *text = value ? json_dumps(value, JSON_ENCODE_ANY) : NULL;
    if (text)
        puts(text);
    free(text);
    json_decref(root);
    return text ? 0 : 1;
}
