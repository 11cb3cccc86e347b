// SPDX-FileCopyrightText: The Windfall authors
// SPDX-License-Identifier: MIT OR Apache-2.0
//
// Instances for an engine: a matrix for each leaf that is there, by columns, as graphics interfaces take them: instances [SCENE [STEPS]].

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "windfall.h"

using Matrix = std::array<float, 16>;

static void check(WindfallStatus status) {
    if (status != WINDFALL_STATUS_OK) {
        throw std::runtime_error(windfall_last_error());
    }
}

// A world that is freed at the end of its scope.
class World {
public:
    explicit World(const std::string &scene) { check(windfall_world_open(scene.c_str(), "cpu", &number)); }
    ~World() { windfall_world_free(number); }
    World(const World &) = delete;
    World &operator=(const World &) = delete;

    void step(uint32_t count) { check(windfall_world_step(number, count)); }

    std::vector<WindfallLeaf> leaves() const {
        size_t count = 0;
        check(windfall_world_leaves(number, nullptr, 0, &count));
        std::vector<WindfallLeaf> leaves(count);
        check(windfall_world_leaves(number, leaves.data(), leaves.size(), &count));
        return leaves;
    }

private:
    WindfallWorld number = 0;
};

// Turns a leaf of length one about its middle into place.
static Matrix instance(const WindfallLeaf &leaf) {
    const auto [x, y, z, w] = leaf.quaternion;
    const float s = leaf.size_m;
    return {
        s * (1 - 2 * (y * y + z * z)), s * 2 * (x * y + z * w), s * 2 * (x * z - y * w), 0,
        s * 2 * (x * y - z * w), s * (1 - 2 * (x * x + z * z)), s * 2 * (y * z + x * w), 0,
        s * 2 * (x * z + y * w), s * 2 * (y * z - x * w), s * (1 - 2 * (x * x + y * y)), 0,
        leaf.position_m[0], leaf.position_m[1], leaf.position_m[2], 1,
    };
}

int main(int count, char **arguments) try {
    World world(count > 1 ? arguments[1] : "six-motions");
    world.step(count > 2 ? static_cast<uint32_t>(std::strtoul(arguments[2], nullptr, 10)) : 120);
    std::vector<Matrix> instances;
    float skewed = 0;
    for (const WindfallLeaf &leaf : world.leaves()) {
        if (leaf.state == 0) {
            continue;
        }
        const Matrix matrix = instance(leaf);
        const float along = std::hypot(matrix[8], matrix[9], matrix[10]);
        skewed = std::max(skewed, std::abs(along / leaf.size_m - 1));
        instances.push_back(matrix);
    }
    std::printf("%zu instances, lengths off by %.6f at most\n", instances.size(), static_cast<double>(skewed));
    return 0;
} catch (const std::exception &error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return 1;
}
