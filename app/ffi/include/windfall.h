// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Falling leaves from C: worlds by number, stepped, counted, lent and saved. Made by cbindgen of app/ffi/src: do not edit.

#ifndef WINDFALL_H
#define WINDFALL_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

// Version of this interface. It changes when a function or a struct does.
#define WINDFALL_ABI_VERSION 1

// Outcome of a call.
typedef enum WindfallStatus {
  // Done.
  WINDFALL_STATUS_OK = 0,
  // A pointer that is null, text that is not UTF-8, an unknown name, too little room.
  WINDFALL_STATUS_ARGUMENT = 1,
  // A scene or a checkpoint that cannot be used.
  WINDFALL_STATUS_SCENE = 2,
  // A device that is missing, too small or lost.
  WINDFALL_STATUS_DEVICE = 3,
  // A world that has been freed, or never was.
  WINDFALL_STATUS_FREED = 4,
  // Columns of the world are lent: give them back first.
  WINDFALL_STATUS_LENT = 5,
  // A fault of the library. The world may be in the middle of a step: free it.
  WINDFALL_STATUS_FAULT = 6,
} WindfallStatus;

// A world, by a number that is never used again; 0 is none.
typedef uint64_t WindfallWorld;

// Time of a world.
typedef struct WindfallClock {
  // Seconds since the scene began.
  double seconds;
  // Steps since then.
  uint32_t step;
  // Length of a step in s.
  float dt_s;
} WindfallClock;

// Counts of a world's leaves.
typedef struct WindfallCounts {
  // All of them.
  uint64_t leaves;
  // Not let go yet.
  uint32_t dormant;
  // On branches.
  uint32_t attached;
  // In the air.
  uint32_t falling;
  // At rest.
  uint32_t resting;
} WindfallCounts;

// A leaf, decoded.
typedef struct WindfallLeaf {
  // Position in m; y points upwards.
  float position_m[3];
  // Length in m.
  float size_m;
  // Orientation: x, y, z, w. The blade lies in its own x-z plane, its upper side to +y, its tip towards +z.
  float quaternion[4];
  // Velocity in m/s.
  float velocity_m_s[3];
  // Time of its release in s.
  float release_s;
  // Number that it keeps until it is let go again.
  uint32_t id;
  // Place of its species in the scene.
  uint32_t species;
  // 0 not let go yet, 1 on a branch, 2 in the air, 3 at rest.
  uint32_t state;
  // 0 none, then the primitive motions in their order, then the regimes of bodies: steady, flutter, tumble, chaotic, helical, spiral, autorotation.
  uint32_t motion;
} WindfallLeaf;

// A column of a world: records of equal size, one for each row, not to be written. It stays where it is until it is given back.
typedef struct WindfallColumn {
  // The first row.
  const uint8_t *data;
  // Number of rows.
  size_t rows;
  // Bytes of a row.
  size_t row_bytes;
} WindfallColumn;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// `WINDFALL_ABI_VERSION` of the library: compare it with that of the header.
uint32_t windfall_abi_version(void);

// Version of the library. The string stays for good.
const char *windfall_version(void);

// A line about what went wrong in the latest call of this thread, empty if nothing did. It stays until the thread's next call.
const char *windfall_last_error(void);

// Builds the world of a preset or of a scene file. `backend` is "auto" (or NULL), "cpu" or "wgpu".
//
// # Safety
// `scene` and `backend` are null or strings that end with a zero; `world` is null or may be written.
enum WindfallStatus windfall_world_open(const char *scene, const char *backend, WindfallWorld *world);

// Builds the world of a scene's text in RON. `file` is the name that errors give it.
//
// # Safety
// `ron`, `file` and `backend` are null or strings that end with a zero; `world` is null or may be written.
enum WindfallStatus windfall_world_from_ron(const char *ron,
                                            const char *file,
                                            const char *backend,
                                            WindfallWorld *world);

// Goes on from the bytes of a checkpoint, which `windfall simulate --checkpoint` and `windfall_world_save` write.
//
// # Safety
// `bytes` is null or `length` bytes may be read from there on; `backend` is null or a string that ends with a zero; `world` is null or may
// be written.
enum WindfallStatus windfall_world_from_checkpoint(const uint8_t *bytes,
                                                   size_t length,
                                                   const char *backend,
                                                   WindfallWorld *world);

// Frees a world. Its number is refused from then on.
enum WindfallStatus windfall_world_free(WindfallWorld world);

// Steps a world so many times. Refused while columns of it are lent.
enum WindfallStatus windfall_world_step(WindfallWorld world, uint32_t count);

// Time of a world.
//
// # Safety
// `clock` is null or may be written.
enum WindfallStatus windfall_world_clock(WindfallWorld world, struct WindfallClock *clock);

// Hash of the whole state: that of `windfall simulate`, and equal on every backend that keeps the exact contract.
//
// # Safety
// `hash` is null or may be written.
enum WindfallStatus windfall_world_hash(WindfallWorld world, uint64_t *hash);

// Counts of a world's leaves.
//
// # Safety
// `counts` is null or may be written.
enum WindfallStatus windfall_world_counts(WindfallWorld world, struct WindfallCounts *counts);

// Decodes all leaves, in the order of their slots, as far as there is room; `count` takes how many there are. `leaves` may be null if
// `capacity` is 0.
//
// # Safety
// `leaves` is null or `capacity` leaves may be written there; `count` is null or may be written.
enum WindfallStatus windfall_world_leaves(WindfallWorld world,
                                          struct WindfallLeaf *leaves,
                                          size_t capacity,
                                          size_t *count);

// Name of a column by its number, NULL past the last: "place" of leaves, "particles.place" of other stores. The string stays for good.
const char *windfall_column_name(size_t number);

// Lends a column of a world by name, without a copy. Give it back by `windfall_column_release`, after which it may move; until then the
// world neither steps nor is freed.
//
// # Safety
// `name` is null or a string that ends with a zero; `column` is null or may be written.
enum WindfallStatus windfall_column_lend(WindfallWorld world,
                                         const char *name,
                                         struct WindfallColumn *column);

// Gives back a column of a world.
enum WindfallStatus windfall_column_release(WindfallWorld world);

// Writes the state as a checkpoint, with its scene; `length` takes how many bytes it has. Refused if there is too little room; `bytes` may be
// null if `capacity` is 0.
//
// # Safety
// `bytes` is null or `capacity` bytes may be written there; `length` is null or may be written.
enum WindfallStatus windfall_world_save(WindfallWorld world,
                                        uint8_t *bytes,
                                        size_t capacity,
                                        size_t *length);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* WINDFALL_H */
