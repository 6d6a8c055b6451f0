#include "src/pictures/shape_view.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "src/base/index.hpp"

namespace coseg {

namespace {

struct NamedView {
    const char* name;
    double azimuth;
    double elevation;
};

constexpr std::array<NamedView, 7> named_views{{{"front", 0.0, 0.0},
                                                {"back", 180.0, 0.0},
                                                {"left", -90.0, 0.0},
                                                {"right", 90.0, 0.0},
                                                {"top", 0.0, 90.0},
                                                {"bottom", 0.0, -90.0},
                                                {"corner", 35.0, 25.0}}};

/// Columns: to the right of the front, up, front.
Eigen::Matrix3d frame_of(UpAxis up) {
    const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
    const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
    Eigen::Matrix3d frame;
    switch (up) {
        case UpAxis::x:
            frame << -y, x, z;
            break;
        case UpAxis::y:
            frame << x, y, z;
            break;
        case UpAxis::z:
            frame << x, z, -y;
            break;
    }
    return frame;
}

constexpr int raster = 96;

using Raster = std::array<std::uint8_t, static_cast<std::size_t>(raster) * raster>;

double edge_side(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double x, double y) {
    return (b.x() - a.x()) * (y - a.y()) - (b.y() - a.y()) * (x - a.x());
}

/// Marks the pixels whose middle the triangle covers; corners in pixels.
void cover(Raster& covered, const std::array<Eigen::Vector2d, 3>& corners) {
    const auto [a, b, c] = corners;
    // Pixels whose middle lies between the least and the largest coordinate: none for most small triangles.
    const auto first = [](double least) { return std::max(0, static_cast<int>(std::ceil(least - 0.5))); };
    const auto last = [](double most) {
        return std::min(raster - 1, static_cast<int>(std::floor(most - 0.5)));
    };
    const int low_x = first(std::min({a.x(), b.x(), c.x()}));
    const int high_x = last(std::max({a.x(), b.x(), c.x()}));
    const int low_y = first(std::min({a.y(), b.y(), c.y()}));
    const int high_y = last(std::max({a.y(), b.y(), c.y()}));
    if (low_x > high_x) return;
    const double turn = edge_side(a, b, c.x(), c.y()) < 0.0 ? -1.0 : 1.0;
    for (int y = low_y; y <= high_y; ++y) {
        for (int x = low_x; x <= high_x; ++x) {
            const double px = x + 0.5;
            const double py = y + 0.5;
            if (turn * edge_side(a, b, px, py) >= 0.0 && turn * edge_side(b, c, px, py) >= 0.0 &&
                turn * edge_side(c, a, px, py) >= 0.0)
                covered[at(y * raster + x)] = 1;
        }
    }
}

double outline_area(const TriMesh& mesh, const View& view) {
    Eigen::Matrix<double, 2, 3> plane;
    plane << view.right().transpose(), view.up.transpose();
    const Eigen::Matrix2Xd points = plane * mesh.vertices;
    const Eigen::Vector2d low = points.rowwise().minCoeff();
    const double extent = (points.rowwise().maxCoeff() - low).maxCoeff();
    if (!(extent > 0.0)) return 0.0;
    const double scale = raster / extent;
    Raster covered{};
    for (int f = 0; f < mesh.face_count(); ++f) {
        std::array<Eigen::Vector2d, 3> corners;
        for (int k = 0; k < 3; ++k) corners[at(k)] = (points.col(mesh.faces(k, f)) - low) * scale;
        cover(covered, corners);
    }
    const auto count = std::count(covered.begin(), covered.end(), std::uint8_t{1});
    return static_cast<double>(count) / (scale * scale);
}

/// Two numbers with a comma between them and nothing else.
std::optional<std::array<double, 2>> two_numbers(const std::string& text) {
    char* end = nullptr;
    const double first = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || *end != ',') return std::nullopt;
    const char* rest = end + 1;
    const double second = std::strtod(rest, &end);
    if (end == rest || *end != '\0' || !std::isfinite(first) || !std::isfinite(second)) return std::nullopt;
    return std::array<double, 2>{first, second};
}

}  // namespace

View view_from(UpAxis up, double azimuth, double elevation) {
    const double a = azimuth * std::numbers::pi / 180.0;
    const double e = elevation * std::numbers::pi / 180.0;
    const Eigen::Vector3d towards(std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e));
    const Eigen::Vector3d upwards(-std::sin(a) * std::sin(e), std::cos(e), -std::cos(a) * std::sin(e));
    const Eigen::Matrix3d frame = frame_of(up);
    return {frame * towards, frame * upwards};
}

std::optional<View> named_view(const std::string& text, UpAxis up) {
    for (const NamedView& view : named_views) {
        if (text == view.name) return view_from(up, view.azimuth, view.elevation);
    }
    const auto angles = two_numbers(text);
    if (!angles || std::abs((*angles)[1]) > 90.0) return std::nullopt;
    return view_from(up, (*angles)[0], (*angles)[1]);
}

std::vector<View> candidate_views(const std::vector<UpAxis>& axes) {
    std::vector<View> views;
    for (const UpAxis up : axes) {
        for (const double elevation : {20.0, 35.0, 50.0}) {
            for (const double azimuth : {30.0, -30.0, 45.0, -45.0, 60.0, -60.0, 15.0, -15.0})
                views.push_back(view_from(up, azimuth, elevation));
        }
    }
    return views;
}

std::vector<double> outline_areas(const TriMesh& mesh, const std::vector<View>& views) {
    std::vector<double> areas;
    areas.reserve(views.size());
    for (const View& view : views) areas.push_back(outline_area(mesh, view));
    return areas;
}

Eigen::Vector3d standing_shares(const TriMesh& mesh) {
    constexpr double ground = 0.05;
    const Eigen::Vector3d low = mesh.vertices.rowwise().minCoeff();
    const Eigen::Vector3d extent = mesh.vertices.rowwise().maxCoeff() - low;
    Eigen::Vector3d shares = Eigen::Vector3d::Zero();
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        Eigen::Array2d least = Eigen::Array2d::Constant(std::numeric_limits<double>::infinity());
        Eigen::Array2d most = -least;
        for (const auto& point : mesh.vertices.colwise()) {
            if (point[axis] - low[axis] > ground * extent[axis]) continue;
            const Eigen::Array2d place(point[u], point[v]);
            least = least.min(place);
            most = most.max(place);
        }
        const double whole = extent[u] * extent[v];
        if (whole > 0.0) shares[axis] = (most - least).prod() / whole;
    }
    return shares;
}

Eigen::Vector3d mirror_differences(const TriMesh& mesh) {
    constexpr int places = 16;
    const Eigen::Vector3d low = mesh.vertices.rowwise().minCoeff();
    const Eigen::Vector3d extent = mesh.vertices.rowwise().maxCoeff() - low;
    Eigen::Matrix<double, 3, places + 1> areas = Eigen::Matrix<double, 3, places + 1>::Zero();
    for (int f = 0; f < mesh.face_count(); ++f) {
        const Eigen::Vector3d a = mesh.vertices.col(mesh.faces(0, f));
        const Eigen::Vector3d b = mesh.vertices.col(mesh.faces(1, f));
        const Eigen::Vector3d c = mesh.vertices.col(mesh.faces(2, f));
        const double area = (b - a).cross(c - a).norm();
        for (const Eigen::Vector3d& corner : {a, b, c}) {
            for (int axis = 0; axis < 3; ++axis) {
                if (!(extent[axis] > 0.0)) continue;
                // Shared between the two next places, so that a mirror image has the mirrored shares.
                const double at = places * (corner[axis] - low[axis]) / extent[axis];
                const int place = std::clamp(static_cast<int>(at), 0, places - 1);
                areas(axis, place) += area * (place + 1 - at);
                areas(axis, place + 1) += area * (at - place);
            }
        }
    }
    const Eigen::Vector3d whole = areas.rowwise().sum().cwiseMax(std::numeric_limits<double>::min());
    return (areas - areas.rowwise().reverse()).cwiseAbs().rowwise().sum().cwiseQuotient(2.0 * whole);
}

}  // namespace coseg
