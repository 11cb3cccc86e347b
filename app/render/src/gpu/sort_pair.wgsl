// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
// A key and the value that is sorted by it. Only the device writes and reads it.

struct SortPair {
    key: u32,
    value: u32,
}
