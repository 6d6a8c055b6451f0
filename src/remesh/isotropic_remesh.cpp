#include "src/remesh/isotropic_remesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include "src/base/error.hpp"
#include "src/mesh/closest_point.hpp"

namespace coseg {

namespace {

using Eigen::Vector3d;

struct KernelTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    using Normal = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::Status);
    EdgeAttributes(OpenMesh::Attributes::Status);
    FaceAttributes(OpenMesh::Attributes::Status);
    HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
};
using Kernel = OpenMesh::TriMesh_ArrayKernelT<KernelTraits>;
using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

/// What holds a vertex: nothing, a line (boundary or sharp edge) along which it may move, or a corner of
/// lines.
enum class Hold { free, line, corner };

using LineProjection = std::function<Vector3d(const Vector3d&)>;

OpenMesh::Vec3d to_point(const Vector3d& p) { return {p[0], p[1], p[2]}; }

Vector3d from_point(const OpenMesh::Vec3d& p) { return {p[0], p[1], p[2]}; }

Kernel to_kernel(const TriMesh& mesh) {
    Kernel kernel;
    kernel.reserve(mesh.vertex_count(), mesh.face_count() * 3 / 2, mesh.face_count());
    for (int v = 0; v < mesh.vertex_count(); ++v) kernel.add_vertex(to_point(mesh.vertices.col(v)));
    omerr().disable();  // a refused face is reported by the error below
    for (int f = 0; f < mesh.face_count(); ++f) {
        const FaceHandle face = kernel.add_face(
            VertexHandle(mesh.faces(0, f)), VertexHandle(mesh.faces(1, f)), VertexHandle(mesh.faces(2, f)));
        if (!face.is_valid()) {
            throw Error(ExitCode::input,
                        "face " + std::to_string(f) +
                            " makes the mesh non-manifold; repair the mesh before remeshing it");
        }
    }
    omerr().enable();
    return kernel;
}

/// Vertices that no face uses are left out.
TriMesh from_kernel(const Kernel& kernel) {
    std::vector<int> number(kernel.n_vertices(), -1);
    TriMesh mesh;
    mesh.vertices.resize(3, static_cast<Eigen::Index>(kernel.n_vertices()));
    mesh.faces.resize(3, static_cast<Eigen::Index>(kernel.n_faces()));
    int vertices = 0;
    for (const VertexHandle v : kernel.vertices()) {
        if (kernel.is_isolated(v)) continue;
        mesh.vertices.col(vertices) = from_point(kernel.point(v));
        number[v.idx()] = vertices++;
    }
    mesh.vertices.conservativeResize(3, vertices);
    for (const FaceHandle f : kernel.faces()) {
        int corner = 0;
        for (const VertexHandle v : kernel.fv_range(f)) mesh.faces(corner++, f.idx()) = number[v.idx()];
    }
    return mesh;
}

Vector3d area_vector(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return 0.5 * (b - a).cross(c - a);
}

class Remesher {
  public:
    Remesher(const TriMesh& mesh, const RemeshOptions& options)
        : kernel_(to_kernel(mesh)), options_(options) {
        kernel_.add_property(wanted_);
        mark_lines();
    }

    /// Segments of the lines as degenerate faces (a, b, b); no faces where there are no lines.
    [[nodiscard]] TriMesh lines() const {
        std::vector<Eigen::Vector3i> segments;
        TriMesh mesh;
        mesh.vertices.resize(3, static_cast<Eigen::Index>(kernel_.n_vertices()));
        for (const VertexHandle v : kernel_.vertices()) mesh.vertices.col(v.idx()) = point_of(v);
        for (const EdgeHandle e : kernel_.edges()) {
            if (!is_line(e)) continue;
            const HalfedgeHandle h = kernel_.halfedge_handle(e, 0);
            const int b = kernel_.to_vertex_handle(h).idx();
            segments.emplace_back(kernel_.from_vertex_handle(h).idx(), b, b);
        }
        mesh.faces.resize(3, static_cast<Eigen::Index>(segments.size()));
        for (std::size_t s = 0; s < segments.size(); ++s)
            mesh.faces.col(static_cast<Eigen::Index>(s)) = segments[s];
        return mesh;
    }

    /// The mesh after the last round, or within the limits that of the round with the fewest faces.
    TriMesh run(const SurfaceProjection& project, const LineProjection& project_line) {
        std::optional<TriMesh> fewest;
        int before = std::numeric_limits<int>::max();
        for (int round = 0; round < options_.iterations; ++round) {
            want_lengths();
            if (!split_long_edges()) return within_limits(fewest);
            collapse_short_edges();
            kernel_.garbage_collection();
            flip_edges(project);
            relax(project, project_line);
            if (face_count() > options_.most_faces && face_count() > before) return within_limits(fewest);
            before = face_count();
            if (is_limited() && before <= options_.most_faces && (!fewest || before < fewest->face_count())) {
                fewest = from_kernel(kernel_);
            }
        }
        return face_count() <= options_.most_faces ? from_kernel(kernel_) : within_limits(fewest);
    }

  private:
    [[nodiscard]] int face_count() const { return static_cast<int>(kernel_.n_faces()); }

    [[nodiscard]] bool is_limited() const {
        return std::min(options_.most_faces, options_.most_faces_at_once) < std::numeric_limits<int>::max();
    }

    [[nodiscard]] TriMesh within_limits(const std::optional<TriMesh>& fewest) const {
        if (fewest) return *fewest;
        throw Error(ExitCode::input, "even triangles of the wanted size would be more than " +
                                         std::to_string(options_.most_faces));
    }

    [[nodiscard]] Vector3d point_of(VertexHandle v) const { return from_point(kernel_.point(v)); }

    [[nodiscard]] bool is_line(EdgeHandle e) const { return kernel_.status(e).feature(); }

    void mark_lines() {
        for (const EdgeHandle e : kernel_.edges()) {
            bool line = kernel_.is_boundary(e);
            if (!line) {
                const Vector3d a = face_vector(kernel_.face_handle(kernel_.halfedge_handle(e, 0)));
                const Vector3d b = face_vector(kernel_.face_handle(kernel_.halfedge_handle(e, 1)));
                line = std::atan2(a.cross(b).norm(), a.dot(b)) > options_.sharp_angle;
            }
            kernel_.status(e).set_feature(line);
        }
    }

    [[nodiscard]] Vector3d face_vector(FaceHandle f) const {
        const HalfedgeHandle h = kernel_.halfedge_handle(f);
        return area_vector(point_of(kernel_.from_vertex_handle(h)), point_of(kernel_.to_vertex_handle(h)),
                           point_of(kernel_.to_vertex_handle(kernel_.next_halfedge_handle(h))));
    }

    [[nodiscard]] Hold hold(VertexHandle v) const {
        // Cosine between the two directions of a line that does not turn sharply.
        constexpr double straight = -0.7;
        std::array<Vector3d, 2> directions;
        int lines = 0;
        for (const HalfedgeHandle h : kernel_.voh_range(v)) {
            if (!is_line(kernel_.edge_handle(h))) continue;
            if (lines < 2)
                directions[lines] = (point_of(kernel_.to_vertex_handle(h)) - point_of(v)).normalized();
            ++lines;
        }
        if (lines == 0) return Hold::free;
        return lines == 2 && directions[0].dot(directions[1]) < straight ? Hold::line : Hold::corner;
    }

    [[nodiscard]] double length(EdgeHandle e) const {
        const HalfedgeHandle h = kernel_.halfedge_handle(e, 0);
        return (point_of(kernel_.to_vertex_handle(h)) - point_of(kernel_.from_vertex_handle(h))).norm();
    }

    [[nodiscard]] double wanted_length(VertexHandle v) const { return kernel_.property(wanted_, v); }

    [[nodiscard]] double wanted_length(EdgeHandle e) const {
        const HalfedgeHandle h = kernel_.halfedge_handle(e, 0);
        return std::min(wanted_length(kernel_.from_vertex_handle(h)),
                        wanted_length(kernel_.to_vertex_handle(h)));
    }

    [[nodiscard]] std::vector<Vector3d> vertex_normals() const {
        std::vector<Vector3d> normals(kernel_.n_vertices(), Vector3d::Zero());
        for (const FaceHandle f : kernel_.faces()) {
            const Vector3d vector = face_vector(f);
            for (const VertexHandle v : kernel_.fv_range(f)) normals[v.idx()] += vector;
        }
        for (Vector3d& normal : normals) normal.normalize();
        return normals;
    }

    /// Sets every vertex's wanted length from the steepest turn of the normal along its edges, evened out a
    /// little.
    void want_lengths() {
        constexpr double turn_per_edge = 1.0;
        constexpr int smoothing_rounds = 2;
        const double shortest = options_.smallest_share * options_.edge_length;
        const std::vector<Vector3d> normals =
            options_.smallest_share < 1.0 ? vertex_normals() : std::vector<Vector3d>();
        for (const VertexHandle v : kernel_.vertices()) {
            double curvature = turn_per_edge / options_.edge_length;
            for (const VertexHandle n : kernel_.vv_range(v)) {
                const double step = (point_of(n) - point_of(v)).norm();
                if (normals.empty() || step < 0.5 * shortest) continue;  // short edges of the input are noise
                curvature = std::max(curvature, (normals[n.idx()] - normals[v.idx()]).norm() / step);
            }
            kernel_.property(wanted_, v) = std::max(turn_per_edge / curvature, shortest);
        }
        for (int round = 0; round < smoothing_rounds && !normals.empty(); ++round) smooth_wanted_lengths();
    }

    void smooth_wanted_lengths() {
        std::vector<double> mean(kernel_.n_vertices(), 0.0);
        for (const VertexHandle v : kernel_.vertices()) {
            int neighbours = 0;
            for (const VertexHandle n : kernel_.vv_range(v)) {
                mean[v.idx()] += wanted_length(n);
                ++neighbours;
            }
            mean[v.idx()] =
                neighbours > 0 ? 0.5 * (mean[v.idx()] / neighbours + wanted_length(v)) : wanted_length(v);
        }
        for (const VertexHandle v : kernel_.vertices()) kernel_.property(wanted_, v) = mean[v.idx()];
    }

    /// False if there would be more faces than are allowed at once.
    [[nodiscard]] bool split_long_edges() {
        constexpr int most_halvings = 12;
        for (int pass = 0, split = 1; pass < most_halvings && split > 0; ++pass) {
            split = 0;
            const int edges = static_cast<int>(kernel_.n_edges());
            for (int i = 0; i < edges; ++i) {
                if (length(EdgeHandle(i)) <= 4.0 / 3.0 * wanted_length(EdgeHandle(i))) continue;
                if (!has_middle(EdgeHandle(i))) continue;
                if (face_count() >= options_.most_faces_at_once) return false;
                split_edge(EdgeHandle(i));
                ++split;
            }
        }
        return true;
    }

    /// False where doubles have no point between the ends, as far from the origin.
    [[nodiscard]] bool has_middle(EdgeHandle e) const {
        const HalfedgeHandle h = kernel_.halfedge_handle(e, 0);
        const Vector3d a = point_of(kernel_.from_vertex_handle(h));
        const Vector3d b = point_of(kernel_.to_vertex_handle(h));
        const Vector3d middle = 0.5 * (a + b);
        return middle != a && middle != b;
    }

    void split_edge(EdgeHandle e) {
        const HalfedgeHandle h = kernel_.halfedge_handle(e, 0);
        const VertexHandle a = kernel_.from_vertex_handle(h);
        const VertexHandle b = kernel_.to_vertex_handle(h);
        const bool line = is_line(e);
        const VertexHandle middle = kernel_.add_vertex(to_point(0.5 * (point_of(a) + point_of(b))));
        kernel_.property(wanted_, middle) = 0.5 * (wanted_length(a) + wanted_length(b));
        kernel_.split(e, middle);
        for (const HalfedgeHandle spoke : kernel_.voh_range(middle)) {
            const VertexHandle end = kernel_.to_vertex_handle(spoke);
            kernel_.status(kernel_.edge_handle(spoke)).set_feature(line && (end == a || end == b));
        }
    }

    void collapse_short_edges() {
        for (int i = 0; i < static_cast<int>(kernel_.n_edges()); ++i) {
            const EdgeHandle e(i);
            if (kernel_.status(e).deleted() || length(e) >= 4.0 / 5.0 * wanted_length(e)) continue;
            if (!try_collapse(kernel_.halfedge_handle(e, 0))) try_collapse(kernel_.halfedge_handle(e, 1));
        }
    }

    /// Removes the halfedge's start if that neither leaves a line, folds a face nor makes an edge too long.
    bool try_collapse(HalfedgeHandle h) {
        const VertexHandle from = kernel_.from_vertex_handle(h);
        const VertexHandle to = kernel_.to_vertex_handle(h);
        const Hold hold_from = hold(from);
        const bool along_line = is_line(kernel_.edge_handle(h));
        if (hold_from == Hold::corner || (hold_from == Hold::line && !along_line)) return false;
        if (!kernel_.is_collapse_ok(h)) return false;
        // Onto the end point, not the middle: a row of middles would shrink thin limbs away from their
        // surface.
        if (!is_move_ok(from, to, point_of(to))) return false;
        std::array<VertexHandle, 2> opposite{VertexHandle(), VertexHandle()};
        for (int side = 0; side < 2; ++side) {
            const HalfedgeHandle s = side == 0 ? h : kernel_.opposite_halfedge_handle(h);
            if (!kernel_.is_boundary(s))
                opposite[side] = kernel_.to_vertex_handle(kernel_.next_halfedge_handle(s));
        }
        std::array<bool, 2> line_after{};  // the two edges that merge into one on either side
        for (int side = 0; side < 2; ++side) {
            if (!opposite[side].is_valid()) continue;
            line_after[side] = is_line_between(from, opposite[side]) || is_line_between(to, opposite[side]);
        }
        kernel_.collapse(h);
        for (int side = 0; side < 2; ++side) {
            if (!opposite[side].is_valid()) continue;
            const HalfedgeHandle merged = kernel_.find_halfedge(to, opposite[side]);
            kernel_.status(kernel_.edge_handle(merged)).set_feature(line_after[side]);
        }
        return true;
    }

    [[nodiscard]] bool is_line_between(VertexHandle a, VertexHandle b) const {
        return is_line(kernel_.edge_handle(kernel_.find_halfedge(a, b)));
    }

    /// Whether `v` may go to `target` when the faces it shares with `partner` vanish.
    [[nodiscard]] bool is_move_ok(VertexHandle v, VertexHandle partner, const Vector3d& target) const {
        const double wanted = std::min(wanted_length(v), wanted_length(partner));
        for (const HalfedgeHandle h : kernel_.voh_range(v)) {
            const VertexHandle a = kernel_.to_vertex_handle(h);
            const double longest = 4.0 / 3.0 * std::min(wanted, wanted_length(a));
            if (a != partner && (point_of(a) - target).squaredNorm() > longest * longest) return false;
            if (kernel_.is_boundary(h)) continue;
            const VertexHandle b = kernel_.to_vertex_handle(kernel_.next_halfedge_handle(h));
            if (a == partner || b == partner) continue;
            const Vector3d before = area_vector(point_of(v), point_of(a), point_of(b));
            const Vector3d after = area_vector(target, point_of(a), point_of(b));
            if (before.dot(after) <= 0.5 * before.norm() * after.norm()) return false;
        }
        return true;
    }

    [[nodiscard]] int excess_neighbours(VertexHandle v) const {
        return static_cast<int>(kernel_.valence(v)) - (kernel_.is_boundary(v) ? 4 : 6);
    }

    /// An edge (a, b) between the opposite corners c and d.
    struct Quad {
        VertexHandle a, b, c, d;
    };

    [[nodiscard]] Quad quad_of(EdgeHandle e) const {
        const HalfedgeHandle h = kernel_.halfedge_handle(e, 0);
        const HalfedgeHandle o = kernel_.halfedge_handle(e, 1);
        return {kernel_.from_vertex_handle(h), kernel_.to_vertex_handle(h),
                kernel_.to_vertex_handle(kernel_.next_halfedge_handle(h)),
                kernel_.to_vertex_handle(kernel_.next_halfedge_handle(o))};
    }

    void flip_edges(const SurfaceProjection& project) {
        for (const EdgeHandle e : kernel_.edges()) {
            if (is_line(e) || kernel_.is_boundary(e) || !kernel_.is_flip_ok(e)) continue;
            const Quad q = quad_of(e);
            if (is_flip_wanted(q, project) && is_flip_flat(q.a, q.b, q.c, q.d)) kernel_.flip(e);
        }
    }

    /// Towards six neighbours; where the quad is bent, only if the edge does not leave the surface by it, and
    /// also for the sake of the surface alone.
    [[nodiscard]] bool is_flip_wanted(const Quad& q, const SurfaceProjection& project) const {
        constexpr double bent = 0.95;  // cosine of the angle between the two triangles
        constexpr double slight = 0.02;
        const std::array<int, 4> x{excess_neighbours(q.a), excess_neighbours(q.b), excess_neighbours(q.c),
                                   excess_neighbours(q.d)};
        const int gain = std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]) + std::abs(x[3]) -
                         std::abs(x[0] - 1) - std::abs(x[1] - 1) - std::abs(x[2] + 1) - std::abs(x[3] + 1);
        const Vector3d first = area_vector(point_of(q.a), point_of(q.b), point_of(q.c));
        const Vector3d second = area_vector(point_of(q.a), point_of(q.d), point_of(q.b));
        if (first.dot(second) > bent * first.norm() * second.norm()) return gain > 0;
        const Vector3d normal = (first + second).normalized();
        const auto off_surface = [&](VertexHandle from, VertexHandle to) {
            const Vector3d middle = 0.5 * (point_of(from) + point_of(to));
            return (project(middle, normal) - middle).norm();
        };
        const double now = off_surface(q.a, q.b);
        const double then = off_surface(q.c, q.d);
        if (gain > 0) return then <= std::max(now, slight * options_.edge_length);
        return gain >= -2 && then < 0.6 * now && now > slight * options_.edge_length;
    }

    /// Whether triangles (a, d, c) and (d, b, c) may stand for (a, b, c) and (a, d, b) without folding over.
    [[nodiscard]] bool is_flip_flat(VertexHandle a, VertexHandle b, VertexHandle c, VertexHandle d) const {
        const Vector3d pa = point_of(a);
        const Vector3d pb = point_of(b);
        const Vector3d pc = point_of(c);
        const Vector3d pd = point_of(d);
        const Vector3d old_sum = area_vector(pa, pb, pc) + area_vector(pa, pd, pb);
        const Vector3d first = area_vector(pa, pd, pc);
        const Vector3d second = area_vector(pd, pb, pc);
        return first.dot(old_sum) > 0.5 * first.norm() * old_sum.norm() &&
               second.dot(old_sum) > 0.5 * second.norm() * old_sum.norm();
    }

    void relax(const SurfaceProjection& project, const LineProjection& project_line) {
        const std::vector<Vector3d> normal = vertex_normals();
        std::vector<double> area(kernel_.n_vertices(), 0.0);  // over the wanted one
        for (const FaceHandle f : kernel_.faces()) {
            const double face_area = face_vector(f).norm();
            for (const VertexHandle v : kernel_.fv_range(f))
                area[v.idx()] += face_area / std::pow(wanted_length(v), 2);
        }
        std::vector<Vector3d> moved(kernel_.n_vertices());
        for (const VertexHandle v : kernel_.vertices()) {
            moved[v.idx()] = relaxed_point(v, normal[v.idx()], area, project, project_line);
        }
        for (const VertexHandle v : kernel_.vertices()) kernel_.set_point(v, to_point(moved[v.idx()]));
    }

    [[nodiscard]] Vector3d relaxed_point(VertexHandle v, const Vector3d& normal,
                                         const std::vector<double>& area, const SurfaceProjection& project,
                                         const LineProjection& project_line) const {
        Vector3d p = point_of(v);
        const Hold held = hold(v);
        if (held == Hold::corner || kernel_.is_isolated(v)) return p;
        Vector3d sum = Vector3d::Zero();
        double weights = 0.0;
        for (const HalfedgeHandle h : kernel_.voh_range(v)) {
            if (held == Hold::line && !is_line(kernel_.edge_handle(h))) continue;
            const VertexHandle n = kernel_.to_vertex_handle(h);
            const double weight = held == Hold::line ? 1.0 : area[n.idx()];
            sum += weight * point_of(n);
            weights += weight;
        }
        if (!(weights > 0.0)) return p;
        const Vector3d step = sum / weights - p;
        if (held == Hold::line) return project_line(p + step);
        return project(p + step - normal * normal.dot(step), normal);
    }

    Kernel kernel_;
    RemeshOptions options_;
    OpenMesh::VPropHandleT<double> wanted_;  ///< edge length at a vertex
};

void check_options(const RemeshOptions& options) {
    if (!(options.edge_length > 0.0) || !std::isfinite(options.edge_length)) {
        throw Error(ExitCode::input, "remeshing needs a positive edge length");
    }
}

/// Onto the lines of the mesh as they are before the first round.
LineProjection onto_lines_of(const Remesher& remesher) {
    const TriMesh lines = remesher.lines();
    if (lines.face_count() == 0) return [](const Vector3d& p) { return p; };
    return [tree = ClosestPointTree(lines)](const Vector3d& p) { return tree.nearest(p).point; };
}

}  // namespace

double edge_length_for(double area, int faces) {
    // An equilateral triangle of edge l has area sqrt(3)/4 l^2; edges between 4/5 and 4/3 l average a little
    // less.
    constexpr double measured_mean = 0.96;
    return std::sqrt(4.0 * area / (std::numbers::sqrt3 * faces)) / measured_mean;
}

TriMesh isotropic_remesh(const TriMesh& mesh, const RemeshOptions& options,
                         const SurfaceProjection& project) {
    check_options(options);
    Remesher remesher(mesh, options);
    const LineProjection project_line = onto_lines_of(remesher);
    return remesher.run(project, project_line);
}

TriMesh isotropic_remesh(const TriMesh& mesh, const RemeshOptions& options) {
    check_options(options);
    const ClosestPointTree tree(mesh);
    return isotropic_remesh(mesh, options, [&](const Vector3d& p, const Vector3d& normal) {
        return tree.nearest(p, normal).point;
    });
}

}  // namespace coseg
