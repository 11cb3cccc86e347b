// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Lets a scene fall for so many steps, and says how many leaves are in the air, how high they all are on average, and the hash of the
// state: fall [SCENE [STEPS [BACKEND]]].

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "windfall.h"

static void check(WindfallStatus status) {
    if (status != WINDFALL_STATUS_OK) {
        fprintf(stderr, "error: %s\n", windfall_last_error());
        exit((int)status);
    }
}

// Mean height in m, read where the leaves are. A row of "place" is a position, three floats, and a word of state.
static double mean_height_m(WindfallWorld world) {
    WindfallColumn place;
    check(windfall_column_lend(world, "place", &place));
    double sum = 0.0;
    for (size_t row = 0; row < place.rows; row++) {
        float position_m[3];
        memcpy(position_m, place.data + row * place.row_bytes, sizeof position_m);
        sum += position_m[1];
    }
    double mean = place.rows == 0 ? 0.0 : sum / (double)place.rows;
    check(windfall_column_release(world));
    return mean;
}

int main(int count, char **arguments) {
    const char *scene = count > 1 ? arguments[1] : "six-motions";
    const uint32_t steps = count > 2 ? (uint32_t)strtoul(arguments[2], NULL, 10) : 120;
    const char *backend = count > 3 ? arguments[3] : "cpu";
    if (windfall_abi_version() != WINDFALL_ABI_VERSION) {
        fprintf(stderr, "error: the library has version %" PRIu32 " of the interface, the header %d\n",
                windfall_abi_version(), WINDFALL_ABI_VERSION);
        return 1;
    }
    WindfallWorld world;
    check(windfall_world_open(scene, backend, &world));
    check(windfall_world_step(world, steps));

    WindfallClock clock;
    WindfallCounts counts;
    uint64_t hash;
    check(windfall_world_clock(world, &clock));
    check(windfall_world_counts(world, &counts));
    check(windfall_world_hash(world, &hash));
    printf("%.3f s, %" PRIu64 " leaves, %" PRIu32 " in the air, mean height %.4f m, hash %016" PRIx64 "\n",
           clock.seconds, counts.leaves, counts.falling, mean_height_m(world), hash);
    check(windfall_world_free(world));
    return 0;
}
