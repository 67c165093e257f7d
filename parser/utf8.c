#include "parser/utf8.h"

/* Bytes of a character by its first one; 0: cannot begin one. */
static size_t size_by_lead(unsigned char lead)
{
    return lead < 0x80   ? 1
           : lead < 0xC2 ? 0
           : lead < 0xE0 ? 2
           : lead < 0xF0 ? 3
           : lead < 0xF5 ? 4
                         : 0;
}

static bool is_character(uint32_t code, size_t size)
{
    static const uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    return code >= least[size] && code <= 0x10FFFF &&
           (code < 0xD800 || code > 0xDFFF);
}

/* The size of the well-formed character at `text`, or 0. */
static size_t well_formed(const char *text, size_t length, uint32_t *code)
{
    unsigned char lead = (unsigned char)text[0];
    size_t size = size_by_lead(lead);
    if (size == 0 || size > length) {
        return 0;
    }
    *code = size == 1 ? lead : lead & (0x7Fu >> size);
    for (size_t i = 1; i < size; i++) {
        unsigned char byte = (unsigned char)text[i];
        if ((byte & 0xC0) != 0x80) {
            return 0;
        }
        *code = *code << 6 | (byte & 0x3F);
    }
    return is_character(*code, size) ? size : 0;
}

uint32_t utf8_decode(const char *text, size_t length, size_t *size)
{
    uint32_t code;
    *size = well_formed(text, length, &code);
    if (*size == 0) {
        *size = 1;
        code = (unsigned char)text[0];
    }
    return code;
}

size_t utf8_encode(uint32_t code, char *out)
{
    if (!is_character(code, 1)) {
        code = 0xFFFD;
    }
    if (code < 0x80) {
        out[0] = (char)code;
        return 1;
    }
    size_t size = code < 0x800 ? 2 : code < 0x10000 ? 3 : 4;
    for (size_t i = size - 1; i > 0; i--) {
        out[i] = (char)(0x80 | (code & 0x3F));
        code >>= 6;
    }
    out[0] = (char)((0xF00u >> size) | code);
    return size;
}

bool utf8_valid(const char *text, size_t length)
{
    uint32_t code;
    for (size_t at = 0; at < length;) {
        size_t size = well_formed(text + at, length - at, &code);
        if (size == 0) {
            return false;
        }
        at += size;
    }
    return true;
}

size_t utf8_count(const char *text, size_t length)
{
    size_t count = 0, size;
    for (size_t at = 0; at < length; at += size) {
        utf8_decode(text + at, length - at, &size);
        count++;
    }
    return count;
}

size_t utf8_cut(const char *text, size_t length, size_t count)
{
    size_t at = 0, size;
    for (; at < length && count > 0; at += size, count--) {
        utf8_decode(text + at, length - at, &size);
    }
    return at;
}
