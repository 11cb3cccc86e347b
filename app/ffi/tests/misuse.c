// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Calls that are wrong: each has its status and its line, and the world goes on.

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "windfall.h"

// Ends the program if a call has another outcome, or a line without `part`.
static void expect(int line, WindfallStatus status, WindfallStatus wanted, const char *part) {
    if (status != wanted || strstr(windfall_last_error(), part) == NULL) {
        fprintf(stderr, "line %d: status %d, not %d; said '%s', without '%s'\n", line, (int)status, (int)wanted,
                windfall_last_error(), part);
        exit(1);
    }
}
#define EXPECT(call, wanted, part) expect(__LINE__, (call), (wanted), (part))

static const char *const RON = "(name: \"one\", sources: [(shape: Disc(center_m: (0.0, 3.0, 0.0), radius_m: 1.0), count: 10)])";

int main(void) {
    WindfallWorld world = 0;
    size_t size = 0;
    EXPECT(windfall_world_open(NULL, "cpu", &world), WINDFALL_STATUS_ARGUMENT, "scene is NULL");
    EXPECT(windfall_world_open("million", "cpu", NULL), WINDFALL_STATUS_ARGUMENT, "world is NULL");
    EXPECT(windfall_world_open("\xff", "cpu", &world), WINDFALL_STATUS_ARGUMENT, "scene is not UTF-8");
    EXPECT(windfall_world_open("autum-park", "cpu", &world), WINDFALL_STATUS_SCENE, "autumn-park");
    EXPECT(windfall_world_from_ron(RON, "one.ron", "gpu", &world), WINDFALL_STATUS_ARGUMENT, "backend is 'gpu'; allowed: 'auto'");
    EXPECT(windfall_world_from_ron("(dt_s: -1.0)", "bad.ron", "cpu", &world), WINDFALL_STATUS_SCENE, "bad.ron: dt_s is -1");
    EXPECT(windfall_world_from_ron("(species: [(name: \"oak\", leaves: Some(\"mine\"), flight: Aerodynamic(()))])", "own.ron", "cpu", &world),
           WINDFALL_STATUS_SCENE, "own.ron: species[0].leaves is \"mine\"; allowed: None");
    EXPECT(windfall_world_from_ron("(", "cut.ron", "cpu", &world), WINDFALL_STATUS_SCENE, "cut.ron");
    EXPECT(windfall_world_from_checkpoint((const uint8_t *)"none", 4, "cpu", &world), WINDFALL_STATUS_SCENE, "<bytes>");
    EXPECT(windfall_world_step(world, 1), WINDFALL_STATUS_FREED, "world 0 has been freed");

    EXPECT(windfall_world_from_ron(RON, "one.ron", "cpu", &world), WINDFALL_STATUS_OK, "");
    if (world == 0) {
        return 1;
    }
    WindfallColumn column;
    EXPECT(windfall_column_lend(world, "places", &column), WINDFALL_STATUS_ARGUMENT, "no column 'places'; allowed: place,");
    EXPECT(windfall_column_release(world), WINDFALL_STATUS_ARGUMENT, "no column of the world is lent");
    EXPECT(windfall_column_lend(world, "place", &column), WINDFALL_STATUS_OK, "");
    if (column.rows != 10 || column.row_bytes != 16) {
        return 2;
    }
    EXPECT(windfall_world_step(world, 1), WINDFALL_STATUS_LENT, "columns of the world are lent (1 of them)");
    EXPECT(windfall_world_free(world), WINDFALL_STATUS_LENT, "windfall_column_release");
    EXPECT(windfall_column_release(world), WINDFALL_STATUS_OK, "");
    EXPECT(windfall_world_step(world, 5), WINDFALL_STATUS_OK, "");
    EXPECT(windfall_world_hash(world, NULL), WINDFALL_STATUS_ARGUMENT, "hash is NULL");
    EXPECT(windfall_world_leaves(world, NULL, 3, &size), WINDFALL_STATUS_ARGUMENT, "leaves is NULL");

    // A checkpoint goes on with the same bits.
    uint64_t hash = 0, resumed = 1;
    EXPECT(windfall_world_save(world, NULL, 0, &size), WINDFALL_STATUS_OK, "");
    uint8_t *bytes = malloc(size);
    EXPECT(windfall_world_save(world, bytes, 1, &size), WINDFALL_STATUS_ARGUMENT, "capacity is 1; allowed: 0, or");
    EXPECT(windfall_world_save(world, bytes, size, &size), WINDFALL_STATUS_OK, "");
    WindfallWorld other = 0;
    EXPECT(windfall_world_from_checkpoint(bytes, size, "cpu", &other), WINDFALL_STATUS_OK, "");
    free(bytes);
    EXPECT(windfall_world_step(world, 7), WINDFALL_STATUS_OK, "");
    EXPECT(windfall_world_step(other, 7), WINDFALL_STATUS_OK, "");
    EXPECT(windfall_world_hash(world, &hash), WINDFALL_STATUS_OK, "");
    EXPECT(windfall_world_hash(other, &resumed), WINDFALL_STATUS_OK, "");
    if (hash != resumed || world == other) {
        return 3;
    }

    EXPECT(windfall_world_free(world), WINDFALL_STATUS_OK, "");
    EXPECT(windfall_world_free(world), WINDFALL_STATUS_FREED, "has been freed");
    EXPECT(windfall_world_hash(world, &hash), WINDFALL_STATUS_FREED, "has been freed");
    EXPECT(windfall_world_free(other), WINDFALL_STATUS_OK, "");

    size_t names = 0;
    while (windfall_column_name(names) != NULL) {
        names++;
    }
    if (names < 10 || strcmp(windfall_column_name(0), "place") != 0) {
        return 4;
    }
    printf("all refused as they should be\n");
    return 0;
}
