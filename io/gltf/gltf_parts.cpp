#include "io/gltf/gltf_parts.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>
#include <utility>

#include "io/files/byte_cursor.hpp"
#include "io/gltf/gltf_compaction.hpp"
#include "io/gltf/gltf_scene.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"
#include "src/pictures/part_colors.hpp"

namespace coseg {

namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr const char* variants_extension = "KHR_materials_variants";
constexpr int index_target = 34963;     // ELEMENT_ARRAY_BUFFER
constexpr int position_target = 34962;  // ARRAY_BUFFER

std::string name_of_part(const GltfObjects& objects, int part) {
    return at(part) < objects.part_names.size() ? objects.part_names[at(part)]
                                                : "part_" + std::to_string(part);
}

/// A document that grows: JSON, and the one buffer that its views refer to.
class GltfDocument {
  public:
    explicit GltfDocument(OrderedJson json) : json_(std::move(json)) {}

    [[nodiscard]] OrderedJson& json() { return json_; }

    /// Appends to a list at the top of the document, and returns the number of the new element.
    int append(const char* list, OrderedJson value) {
        OrderedJson& values = json_[list];
        values.push_back(std::move(value));
        return static_cast<int>(values.size()) - 1;
    }

    /// Where the bytes begin in the buffer, which is a multiple of 4.
    std::size_t append_bytes(std::string_view bytes) {
        binary_.append((4 - binary_.size() % 4) % 4, '\0');
        const std::size_t offset = binary_.size();
        binary_.append(bytes);
        return offset;
    }

    int add_view(std::string_view bytes, int target) {
        OrderedJson view{{"buffer", 0}, {"byteOffset", append_bytes(bytes)}, {"byteLength", bytes.size()}};
        if (target != 0) view["target"] = target;
        return append("bufferViews", std::move(view));
    }

    /// An accessor of whole numbers, in two bytes each where that is enough.
    int add_indices(const std::vector<std::uint32_t>& indices) {
        const std::uint32_t highest = *std::max_element(indices.begin(), indices.end());
        const bool is_short = highest < std::numeric_limits<std::uint16_t>::max();
        std::string bytes;
        for (const std::uint32_t index : indices) {
            if (is_short)
                append_little_endian(bytes, static_cast<std::uint16_t>(index));
            else
                append_little_endian(bytes, index);
        }
        return append("accessors", {{"bufferView", add_view(bytes, index_target)},
                                    {"componentType", is_short ? 5123 : 5125},
                                    {"count", indices.size()},
                                    {"type", "SCALAR"}});
    }

    int add_part_material(const std::string& name, int part) {
        const Color color = part_color(part);
        OrderedJson factor = OrderedJson::array();
        for (const std::uint8_t value : color) factor.push_back(linear_of_srgb(value / 255.0));
        factor.push_back(1.0);
        return append(
            "materials",
            {{"name", name},
             {"pbrMetallicRoughness",
              {{"baseColorFactor", std::move(factor)}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.8}}},
             {"doubleSided", true}});
    }

    std::string finish(const std::string& path) {
        if (!binary_.empty()) {
            OrderedJson& buffers = json_["buffers"];
            OrderedJson buffer =
                buffers.is_array() && !buffers.empty() ? buffers.front() : OrderedJson::object();
            buffer.erase("uri");
            buffer["byteLength"] = binary_.size();
            buffers = OrderedJson::array({std::move(buffer)});
        }
        return glb_of(json_.dump(-1, ' ', false, OrderedJson::error_handler_t::replace), binary_, path);
    }

  private:
    OrderedJson json_;
    std::string binary_;
};

/// A mesh of an object, and what else its node says: a place, a skin.
struct PlacedMesh {
    int mesh;
    OrderedJson node;
};

OrderedJson named_node(const GltfObject& object, const std::string& name) {
    OrderedJson extras{{"part", object.part}};
    if (object.piece >= 0) extras["piece"] = object.piece;
    return {{"name", name}, {"extras", std::move(extras)}};
}

int add_object_node(GltfDocument& document, const GltfObject& object, const std::vector<PlacedMesh>& meshes) {
    OrderedJson node = named_node(object, object.name);
    if (meshes.size() == 1) {
        node["mesh"] = meshes.front().mesh;
        node.update(meshes.front().node);
        return document.append("nodes", std::move(node));
    }
    OrderedJson children = OrderedJson::array();
    for (const PlacedMesh& placed : meshes) {
        OrderedJson child = named_node(object, object.name + " " + std::to_string(children.size() + 1));
        child["mesh"] = placed.mesh;
        child.update(placed.node);
        children.push_back(document.append("nodes", std::move(child)));
    }
    node["children"] = std::move(children);
    return document.append("nodes", std::move(node));
}

/// The nodes of all objects that have meshes, pieces below the node of their part. Returns the top ones.
std::vector<int> add_object_nodes(GltfDocument& document, const GltfObjects& objects,
                                  const std::vector<std::vector<PlacedMesh>>& meshes) {
    std::vector<int> top;
    std::map<int, OrderedJson> pieces;
    for (std::size_t k = 0; k < objects.objects.size(); ++k) {
        if (meshes[k].empty()) continue;
        const GltfObject& object = objects.objects[k];
        const int node = add_object_node(document, object, meshes[k]);
        if (object.piece < 0)
            top.push_back(node);
        else
            pieces[object.part].push_back(node);
    }
    for (auto& [part, children] : pieces) {
        OrderedJson node = named_node({"", part, -1}, name_of_part(objects, part));
        node["children"] = std::move(children);
        top.push_back(document.append("nodes", std::move(node)));
    }
    return top;
}

/// Shares the triangles of a glTF file out among objects.
class GltfPartition {
  public:
    GltfPartition(std::string_view bytes, const std::string& source, const GltfObjects& objects)
        : container_(split_gltf(bytes, source)),
          asset_(read_gltf_asset(container_, source)),
          scene_(gltf_scene(asset_)),
          objects_(objects),
          leaves_faces_out_(std::any_of(objects.object_of_face.begin(), objects.object_of_face.end(),
                                        [](int object) { return object < 0; })),
          document_(OrderedJson::parse(container_.json)) {}

    std::string run(const std::string& path) {
        old_meshes_ = document_.json().value("meshes", OrderedJson::array());
        document_.json()["meshes"] = OrderedJson::array();
        merge_buffers();
        embed_images();
        add_variant();
        keep_other_meshes();
        share_triangles();
        add_nodes();
        const std::string glb = document_.finish(path);
        return leaves_faces_out_ ? compact_glb(glb, path) : glb;
    }

  private:
    /// What triangles must have in common to be in one mesh: the skin, the mesh if it has morph targets (else
    /// -1), and the place in the scene.
    using Place = std::tuple<int, int, std::array<double, 16>>;

    void merge_buffers() {
        std::vector<std::size_t> begins;
        for (const std::string_view buffer : asset_.buffers) begins.push_back(document_.append_bytes(buffer));
        for (std::size_t k = 0; k < asset_.views.size(); ++k) {
            OrderedJson& view = document_.json()["bufferViews"][k];
            view["buffer"] = 0;
            view["byteOffset"] = asset_.views[k].offset + begins[at(asset_.views[k].buffer)];
        }
    }

    static const char* image_type(std::string_view bytes) {
        if (bytes.starts_with("\x89PNG")) return "image/png";
        if (bytes.starts_with("\xff\xd8")) return "image/jpeg";
        if (bytes.starts_with("RIFF")) return "image/webp";
        return bytes.starts_with("\xabKTX") ? "image/ktx2" : nullptr;
    }

    void embed_images() {
        if (!document_.json().contains("images")) return;
        for (OrderedJson& image : document_.json()["images"]) {
            const std::string uri = image.value("uri", "");
            if (uri.empty() || uri.starts_with("data:")) continue;
            try {
                const std::string bytes = file_of_uri(uri, asset_.path);
                const char* type = image_type(bytes);
                if (type == nullptr) continue;
                image.erase("uri");
                image["bufferView"] = document_.add_view(bytes, 0);
                image["mimeType"] = type;
            } catch (const Error&) {
                continue;  // the picture keeps its name, under which it may be found later
            }
        }
    }

    void add_variant() {
        OrderedJson& json = document_.json();
        OrderedJson& variants = json["extensions"][variants_extension]["variants"];
        variants.push_back({{"name", "parts"}});
        variant_ = static_cast<int>(variants.size()) - 1;
        OrderedJson& used = json["extensionsUsed"];
        if (std::find(used.begin(), used.end(), variants_extension) == used.end())
            used.push_back(variants_extension);
    }

    /// Nodes that are not drawn keep their meshes, and others what they have beside triangles.
    void keep_other_meshes() {
        std::set<int> drawn;
        for (const GltfDraw& draw : scene_.draws) drawn.insert(draw.node);
        for (std::size_t k = 0; k < asset_.nodes.size(); ++k) {
            const int mesh = asset_.nodes[k].mesh;
            if (mesh < 0) continue;
            OrderedJson& node = document_.json()["nodes"][k];
            OrderedJson kept = old_meshes_[at(mesh)];
            if (drawn.contains(static_cast<int>(k))) kept["primitives"] = other_primitives(mesh);
            if (!kept["primitives"].empty() && !leaves_faces_out_) {
                node["mesh"] = document_.append("meshes", std::move(kept));
                continue;
            }
            for (const char* of_mesh : {"mesh", "skin", "weights"}) node.erase(of_mesh);
        }
    }

    [[nodiscard]] OrderedJson other_primitives(int mesh) const {
        OrderedJson others = OrderedJson::array();
        for (std::size_t k = 0; k < asset_.meshes[at(mesh)].size(); ++k) {
            if (asset_.meshes[at(mesh)][k].mode < GltfMode::triangles)
                others.push_back(old_meshes_[at(mesh)]["primitives"][k]);
        }
        return others;
    }

    [[nodiscard]] Place place_of(const GltfDraw& draw) const {
        std::array<double, 16> matrix{};
        std::copy_n(draw.to_scene.data(), matrix.size(), matrix.begin());
        const OrderedJson& mesh = old_meshes_[at(draw.mesh)];
        const bool has_targets =
            mesh.contains("weights") || mesh["primitives"][at(draw.primitive)].contains("targets");
        return {asset_.nodes[at(draw.node)].skin, has_targets ? draw.mesh : -1, matrix};
    }

    /// Places are numbered as the file comes to them, so that triangles keep their order.
    int number_of(const Place& place) {
        const auto [found, is_new] = place_numbers_.try_emplace(place, static_cast<int>(places_.size()));
        if (is_new) places_.push_back(place);
        return found->second;
    }

    void share_triangles() {
        primitives_.resize(objects_.objects.size());
        std::size_t face = 0;
        for (const GltfDraw& draw : scene_.draws) {
            std::map<int, std::vector<std::uint32_t>> corners;
            for (const GltfTriangle& triangle : gltf_triangles(asset_, draw)) {
                const int object = face < objects_.object_of_face.size() ? objects_.object_of_face[face] : -1;
                ++face;
                if (object >= 0)
                    corners[object].insert(corners[object].end(), triangle.begin(), triangle.end());
            }
            const int place = number_of(place_of(draw));
            for (const auto& [object, indices] : corners)
                primitives_[at(object)][place].push_back(
                    primitive_of(draw, objects_.objects[at(object)].part, indices));
        }
        if (face == objects_.object_of_face.size()) return;
        throw Error(ExitCode::internal, asset_.path + ": " + std::to_string(objects_.object_of_face.size()) +
                                            " labels for " + std::to_string(face) + " faces");
    }

    OrderedJson primitive_of(const GltfDraw& draw, int part, const std::vector<std::uint32_t>& indices) {
        OrderedJson primitive = old_meshes_[at(draw.mesh)]["primitives"][at(draw.primitive)];
        primitive["indices"] = document_.add_indices(indices);
        primitive.erase("mode");
        OrderedJson& extensions = primitive["extensions"];
        // Its data without compression are there too, and the indices in the compressed ones are others.
        if (extensions.is_object()) extensions.erase("KHR_draco_mesh_compression");
        extensions[variants_extension]["mappings"].push_back(
            {{"material", material_of(part)}, {"variants", OrderedJson::array({variant_})}});
        return primitive;
    }

    int material_of(int part) {
        const auto [found, is_new] = materials_.try_emplace(part, -1);
        if (is_new) found->second = document_.add_part_material(name_of_part(objects_, part), part);
        return found->second;
    }

    PlacedMesh placed_mesh(const GltfObject& object, const Place& place,
                           std::vector<OrderedJson>& primitives) {
        const auto& [skin, morphed, matrix] = place;
        OrderedJson mesh{{"name", object.name}, {"primitives", std::move(primitives)}};
        for (const char* of_targets : {"weights", "extras"}) {
            if (morphed >= 0 && old_meshes_[at(morphed)].contains(of_targets))
                mesh[of_targets] = old_meshes_[at(morphed)][of_targets];
        }
        OrderedJson node = OrderedJson::object();
        if (skin >= 0) node["skin"] = skin;
        has_skin_ = has_skin_ || skin >= 0;
        if (Eigen::Map<const Eigen::Matrix4d>(matrix.data()) != Eigen::Matrix4d::Identity())
            node["matrix"] = matrix;
        return {document_.append("meshes", std::move(mesh)), std::move(node)};
    }

    void add_nodes() {
        std::vector<std::vector<PlacedMesh>> meshes(objects_.objects.size());
        for (std::size_t k = 0; k < meshes.size(); ++k) {
            for (auto& [place, primitives] : primitives_[k])
                meshes[k].push_back(placed_mesh(objects_.objects[k], places_[at(place)], primitives));
        }
        OrderedJson& json = document_.json();
        const std::vector<int> top = add_object_nodes(document_, objects_, meshes);
        if (asset_.scene < 0) json["scenes"] = OrderedJson::array({{{"nodes", asset_.roots}}});
        json["scene"] = std::max(asset_.scene, 0);
        OrderedJson& roots = json["scenes"][at(std::max(asset_.scene, 0))]["nodes"];
        if (leaves_faces_out_ && !has_skin_) roots = OrderedJson::array();
        for (const int node : top) roots.push_back(node);
    }

    GltfContainer container_;
    GltfAsset asset_;
    GltfScene scene_;
    const GltfObjects& objects_;
    bool leaves_faces_out_;
    bool has_skin_ = false;
    GltfDocument document_;
    OrderedJson old_meshes_;
    int variant_ = 0;
    std::map<int, int> materials_;  ///< by part
    std::map<Place, int> place_numbers_;
    std::vector<Place> places_;
    std::vector<std::map<int, std::vector<OrderedJson>>> primitives_;  ///< by object and place
};

int add_positions(GltfDocument& document, const std::vector<Eigen::Vector3f>& vertices) {
    std::string bytes;
    Eigen::Vector3f low = vertices.front();
    Eigen::Vector3f high = low;
    for (const Eigen::Vector3f& p : vertices) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
        for (const float value : p) append_little_endian(bytes, value);
    }
    const auto list = [](const Eigen::Vector3f& p) { return OrderedJson::array({p.x(), p.y(), p.z()}); };
    return document.append("accessors", {{"bufferView", document.add_view(bytes, position_target)},
                                         {"componentType", 5126},
                                         {"count", vertices.size()},
                                         {"type", "VEC3"},
                                         {"min", list(low)},
                                         {"max", list(high)}});
}

/// What a node says of where the surface stands in the scene.
OrderedJson place_of(const GltfSurface& surface) {
    OrderedJson place = OrderedJson::object();
    if (surface.origin != Eigen::Vector3d::Zero())
        place["translation"] = {surface.origin.x(), surface.origin.y(), surface.origin.z()};
    if (surface.scale != 1.0) place["scale"] = {surface.scale, surface.scale, surface.scale};
    return place;
}

}  // namespace

std::string glb_of_surface(const GltfSurface& surface, const GltfObjects& objects, const std::string& path) {
    std::vector<std::vector<std::uint32_t>> corners(objects.objects.size());
    for (std::size_t f = 0; f < surface.triangles.size(); ++f) {
        const int object = objects.object_of_face[f];
        if (object < 0) continue;
        corners[at(object)].insert(corners[at(object)].end(), surface.triangles[f].begin(),
                                   surface.triangles[f].end());
    }
    GltfDocument document({{"asset", {{"version", "2.0"}, {"generator", "coseg"}}}, {"scene", 0}});
    const int positions = add_positions(document, surface.vertices);
    const OrderedJson place = place_of(surface);
    std::map<int, int> materials;
    std::vector<std::vector<PlacedMesh>> meshes(objects.objects.size());
    for (std::size_t k = 0; k < meshes.size(); ++k) {
        if (corners[k].empty()) continue;
        const int part = objects.objects[k].part;
        const auto [material, is_new] = materials.try_emplace(part, -1);
        if (is_new) material->second = document.add_part_material(name_of_part(objects, part), part);
        const OrderedJson primitive{{"attributes", {{"POSITION", positions}}},
                                    {"indices", document.add_indices(corners[k])},
                                    {"material", material->second}};
        meshes[k].push_back({document.append("meshes", {{"name", objects.objects[k].name},
                                                        {"primitives", OrderedJson::array({primitive})}}),
                             place});
    }
    const std::vector<int> top = add_object_nodes(document, objects, meshes);
    document.json()["scenes"] = OrderedJson::array({{{"nodes", top}}});
    return document.finish(path);
}

std::string glb_of_parts(std::string_view bytes, const std::string& source, const GltfObjects& objects,
                         const std::string& path) {
    try {
        return GltfPartition(bytes, source, objects).run(path);
    } catch (const nlohmann::json::exception&) {
        throw Error(ExitCode::input,
                    source + ": the JSON of the file is not as glTF 2.0 says; export the mesh again");
    }
}

}  // namespace coseg
