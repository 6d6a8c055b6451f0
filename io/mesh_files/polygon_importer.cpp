#include "io/mesh_files/polygon_importer.hpp"

#include <OpenMesh/Core/IO/IOManager.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <array>
#include <map>
#include <sstream>

#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

namespace om = OpenMesh;

/// Collects vertices and faces and ignores everything else a file may hold.
class PolygonImporter : public om::IO::BaseImporter {
  public:
    PolygonMesh mesh;

    om::VertexHandle add_vertex() override { return add_vertex(om::Vec3f(0.0F, 0.0F, 0.0F)); }
    om::VertexHandle add_vertex(const om::Vec3f& p) override {
        return add_vertex(om::Vec3d(p[0], p[1], p[2]));
    }
    om::VertexHandle add_vertex(const om::Vec3d& p) override {
        mesh.vertices.emplace_back(p[0], p[1], p[2]);
        return om::VertexHandle(mesh.vertex_count() - 1);
    }
    void set_point(om::VertexHandle vertex, const om::Vec3f& p) override {
        mesh.vertices.at(static_cast<std::size_t>(vertex.idx())) = Eigen::Vector3d(p[0], p[1], p[2]);
    }
    om::FaceHandle add_face(const VHandles& corners) override {
        if (mesh.offsets.empty()) mesh.offsets.push_back(0);
        for (const om::VertexHandle corner : corners) mesh.corners.push_back(corner.idx());
        mesh.offsets.push_back(static_cast<int>(mesh.corners.size()));
        return om::FaceHandle(mesh.face_count() - 1);
    }
    std::size_t n_vertices() const override { return mesh.vertices.size(); }
    std::size_t n_faces() const override { return static_cast<std::size_t>(mesh.face_count()); }
    std::size_t n_edges() const override { return 0; }

    om::HalfedgeHandle add_edge(om::VertexHandle, om::VertexHandle) override { return om::HalfedgeHandle(); }
    om::FaceHandle add_face(om::HalfedgeHandle) override { return om::FaceHandle(); }
    void add_face_texcoords(om::FaceHandle, om::VertexHandle, const std::vector<om::Vec2f>&) override {}
    void add_face_texcoords(om::FaceHandle, om::VertexHandle, const std::vector<om::Vec3f>&) override {}
    void set_face_texindex(om::FaceHandle, int) override {}
    void set_halfedge(om::VertexHandle, om::HalfedgeHandle) override {}
    void set_normal(om::VertexHandle, const om::Vec3f&) override {}
    void set_normal(om::VertexHandle, const om::Vec3d&) override {}
    void set_normal(om::FaceHandle, const om::Vec3f&) override {}
    void set_normal(om::FaceHandle, const om::Vec3d&) override {}
    void set_color(om::VertexHandle, const om::Vec3uc&) override {}
    void set_color(om::VertexHandle, const om::Vec4uc&) override {}
    void set_color(om::VertexHandle, const om::Vec3f&) override {}
    void set_color(om::VertexHandle, const om::Vec4f&) override {}
    void set_color(om::EdgeHandle, const om::Vec3uc&) override {}
    void set_color(om::EdgeHandle, const om::Vec4uc&) override {}
    void set_color(om::EdgeHandle, const om::Vec3f&) override {}
    void set_color(om::EdgeHandle, const om::Vec4f&) override {}
    void set_color(om::FaceHandle, const om::Vec3uc&) override {}
    void set_color(om::FaceHandle, const om::Vec4uc&) override {}
    void set_color(om::FaceHandle, const om::Vec3f&) override {}
    void set_color(om::FaceHandle, const om::Vec4f&) override {}
    void set_texcoord(om::VertexHandle, const om::Vec2f&) override {}
    void set_texcoord(om::VertexHandle, const om::Vec3f&) override {}
    void set_texcoord(om::HalfedgeHandle, const om::Vec2f&) override {}
    void set_texcoord(om::HalfedgeHandle, const om::Vec3f&) override {}
    void set_status(om::VertexHandle, const om::Attributes::StatusInfo&) override {}
    void set_status(om::HalfedgeHandle, const om::Attributes::StatusInfo&) override {}
    void set_status(om::EdgeHandle, const om::Attributes::StatusInfo&) override {}
    void set_status(om::FaceHandle, const om::Attributes::StatusInfo&) override {}
    void set_next(om::HalfedgeHandle, om::HalfedgeHandle) override {}
    void set_face(om::HalfedgeHandle, om::FaceHandle) override {}
    void request_face_texcoords2D() override {}
    void add_texture_information(int, std::string) override {}
};

/// OpenMesh reports on standard error; what is wrong with a file is said once, by us.
class SilentOpenMesh {
  public:
    SilentOpenMesh() : had_errors_(omerr().is_enabled()), had_log_(omlog().is_enabled()) {
        omerr().disable();
        omlog().disable();
    }
    ~SilentOpenMesh() {
        if (had_errors_) omerr().enable();
        if (had_log_) omlog().enable();
    }
    SilentOpenMesh(const SilentOpenMesh&) = delete;
    SilentOpenMesh& operator=(const SilentOpenMesh&) = delete;

  private:
    bool had_errors_;
    bool had_log_;
};

/// The corners of a left-out STL facet: the welded vertices at its positions, new ones where there are none.
std::vector<int> corners_at(const std::vector<Eigen::Vector3d>& points,
                            std::vector<Eigen::Vector3d>& vertices,
                            std::map<std::array<double, 3>, int>& number) {
    std::vector<int> corners;
    for (const Eigen::Vector3d& p : points) {
        const auto [entry, is_new] =
            number.try_emplace({p.x(), p.y(), p.z()}, static_cast<int>(vertices.size()));
        if (is_new) vertices.push_back(p);
        corners.push_back(entry->second);
    }
    return corners;
}

PolygonMesh with_left_out_faces(PolygonMesh mesh, const std::vector<LeftOutFace>& left_out) {
    std::map<std::array<double, 3>, int> number;
    for (const LeftOutFace& face : left_out) {
        if (face.points.empty() || !number.empty()) continue;
        for (int v = 0; v < mesh.vertex_count(); ++v) {
            const Eigen::Vector3d& p = mesh.vertices[at(v)];
            number.try_emplace({p.x(), p.y(), p.z()}, v);
        }
    }
    PolygonMesh whole;
    whole.vertices = std::move(mesh.vertices);
    whole.offsets.push_back(0);
    auto next = left_out.begin();
    for (int f = 0; f <= mesh.face_count(); ++f) {
        for (; next != left_out.end() && next->face == whole.face_count(); ++next) {
            const std::vector<int> corners =
                next->points.empty() ? next->corners : corners_at(next->points, whole.vertices, number);
            whole.corners.insert(whole.corners.end(), corners.begin(), corners.end());
            whole.offsets.push_back(static_cast<int>(whole.corners.size()));
        }
        if (f == mesh.face_count()) break;
        const auto begin = mesh.corners.begin() + mesh.offsets[at(f)];
        const auto end = mesh.corners.begin() + mesh.offsets[at(f) + 1];
        whole.corners.insert(whole.corners.end(), begin, end);
        whole.offsets.push_back(static_cast<int>(whole.corners.size()));
    }
    return whole;
}

}  // namespace

PolygonMesh import_polygons(CheckedMesh checked, const std::string& path) {
    const SilentOpenMesh silence;
    PolygonImporter importer;
    om::IO::Options options = checked.is_binary ? om::IO::Options::Binary : om::IO::Options::Default;
    std::istringstream stream(std::move(checked.plain));
    const bool is_read = om::IO::IOManager().read(stream, checked.extension, importer, options);
    const std::size_t expected = static_cast<std::size_t>(checked.face_count) - checked.left_out.size();
    const bool is_stl = checked.extension == "stl";
    if (!is_read || importer.n_faces() != expected ||
        (!is_stl && importer.n_vertices() != checked.vertices.size())) {
        throw Error(ExitCode::internal, path + ": OpenMesh reads " + std::to_string(importer.n_faces()) +
                                            " of " + std::to_string(expected) +
                                            " faces; export the mesh in another format");
    }
    PolygonMesh mesh = std::move(importer.mesh);
    if (!is_stl) mesh.vertices = std::move(checked.vertices);
    return checked.left_out.empty() ? std::move(mesh)
                                    : with_left_out_faces(std::move(mesh), checked.left_out);
}

}  // namespace coseg
