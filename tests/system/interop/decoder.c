/*
 * A reader of registers that knows nothing of the device but the constants of an exported header. The test puts behind
 * it what the device holds, and a main() with one call of words_at() or bit_at() and of scale() for each register.
 */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>

#include "device.h"

#define NUMBER_OF(type) INTEROPONE_TYPE_##type

static const uint16_t *memory(unsigned space);

/* The number in a pattern of so many bytes, the most significant first, by its type. */
static void number(uint64_t raw, unsigned type, unsigned size)
{
    uint64_t sign = UINT64_C(1) << (8u * size - 1u);
    if (type == NUMBER_OF(FLOAT32)) {
        uint32_t pattern = (uint32_t)raw;
        float value;
        memcpy(&value, &pattern, sizeof value);
        printf(" %.9g", (double)value);
    } else if (type == NUMBER_OF(FLOAT64)) {
        double value;
        memcpy(&value, &raw, sizeof value);
        printf(" %.17g", value);
    } else if ((type == NUMBER_OF(INT16) || type == NUMBER_OF(INT32) || type == NUMBER_OF(INT64)) && (raw & sign)) {
        printf(" -%" PRIu64, (~raw + 1u) & (sign | (sign - 1u)));
    } else {
        printf(" %" PRIu64, raw);
    }
}

/* Print what stands at an address: a text as its characters, anything else as its number. */
static void words_at(const char *name, unsigned address, unsigned words, unsigned space, unsigned type, unsigned order)
{
    const uint16_t *first = memory(space) + address;
    uint64_t raw = 0;
    unsigned at;
    printf("\n%s", name);
    if (type == NUMBER_OF(STRING))
        printf(" ");
    for (at = 0; at < words; at++) {
        unsigned word = first[(order & INTEROPONE_ORDER_CDAB) ? words - 1u - at : at];
        unsigned high = word >> 8, low = word & 0xFFu;
        if (order & INTEROPONE_ORDER_BADC) {
            high = low;
            low = word >> 8;
        }
        raw = raw << 16 | (uint64_t)(high << 8 | low);
        if (type == NUMBER_OF(STRING))
            printf("%c%c", (int)high, (int)low);
    }
    if (type != NUMBER_OF(STRING))
        number(raw, type, 2u * words);
}

static void bit_at(const char *name, unsigned address, unsigned space)
{
    printf("\n%s %u", name, (unsigned)memory(space)[address]);
}

static void scale(int64_t slope, int64_t over, int64_t offset, int64_t below)
{
    printf(" %" PRId64 "/%" PRId64 " %" PRId64 "/%" PRId64, slope, over, offset, below);
}
