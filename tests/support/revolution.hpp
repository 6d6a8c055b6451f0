#pragma once
// A closed surface of revolution, e.g. a dumbbell whose waist is known.

#include <cmath>
#include <numbers>
#include <vector>

#include "src/mesh/tri_mesh.hpp"

namespace coseg::test {

/// Rotates the profile radius[k] > 0 at height[k] (ascending) about the z axis, `around` quads split in two
/// per ring, closed by a fan at either end: 2 * around * radius.size() faces, from the bottom up.
inline TriMesh revolution(const std::vector<double>& height, const std::vector<double>& radius, int around) {
    const int rings = static_cast<int>(radius.size());
    TriMesh mesh;
    mesh.vertices.resize(3, rings * around + 2);
    mesh.faces.resize(3, 2 * around * rings);
    for (int k = 0; k < rings; ++k) {
        for (int j = 0; j < around; ++j) {
            const double angle = 2.0 * std::numbers::pi * j / around;
            const double r = radius[static_cast<std::size_t>(k)];
            mesh.vertices.col(k * around + j) << r * std::cos(angle), r * std::sin(angle),
                height[static_cast<std::size_t>(k)];
        }
    }
    const int bottom = rings * around;
    const int top = bottom + 1;
    mesh.vertices.col(bottom) << 0.0, 0.0, height.front();
    mesh.vertices.col(top) << 0.0, 0.0, height.back();
    int f = 0;
    for (int j = 0; j < around; ++j) mesh.faces.col(f++) << bottom, (j + 1) % around, j;
    for (int k = 0; k + 1 < rings; ++k) {
        for (int j = 0; j < around; ++j) {
            const int a = k * around + j, b = k * around + (j + 1) % around;
            mesh.faces.col(f++) << a, b, b + around;
            mesh.faces.col(f++) << a, b + around, a + around;
        }
    }
    const int last = (rings - 1) * around;
    for (int j = 0; j < around; ++j) mesh.faces.col(f++) << top, last + j, last + (j + 1) % around;
    return mesh;
}

/// Two bulbs about z = -1 and z = 1 joined at a concave waist in the plane z = 0: radius .2 + .6 |sin(pi z /
/// 2)|, z from -1.5 to 1.5. With an even number of rings a ring of vertices lies in the waist.
inline TriMesh dumbbell(int rings, int around) {
    std::vector<double> height, radius;
    for (int k = 0; k <= rings; ++k) {
        const double z = -1.5 + 3.0 * k / rings;
        height.push_back(z);
        radius.push_back(0.2 + 0.6 * std::abs(std::sin(0.5 * std::numbers::pi * z)));
    }
    return revolution(height, radius, around);
}

}  // namespace coseg::test
