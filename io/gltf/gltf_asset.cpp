#include "io/gltf/gltf_asset.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "io/files/base64.hpp"
#include "io/files/text_cursor.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// A value of the JSON that may be there or not, and the way to it for sentences.
class GltfValue {
  public:
    GltfValue(const nlohmann::json& json, const std::string& path) : json_(&json), path_(&path) {}

    [[nodiscard]] bool is_there() const { return json_ != nullptr; }

    /// Of an object; what is not there has no members either.
    GltfValue operator[](const char* key) const {
        if (json_ == nullptr) return {nullptr, *this, key, 0};
        if (!json_->is_object()) fail("is no object");
        const auto found = json_->find(key);
        return {found == json_->end() ? nullptr : &*found, *this, key, 0};
    }

    /// The number of elements of an array; 0 if it is not there.
    [[nodiscard]] std::size_t size() const {
        if (json_ == nullptr) return 0;
        if (!json_->is_array()) fail("is no list");
        return json_->size();
    }
    [[nodiscard]] GltfValue element(std::size_t index) const {
        return {&(*json_)[index], *this, nullptr, index};
    }

    [[nodiscard]] std::size_t whole_number() const {
        constexpr double most = 9e15;  // doubles hold whole numbers up to here
        if (json_ != nullptr && json_->is_number_unsigned()) return json_->get<std::size_t>();
        if (json_ != nullptr && json_->is_number()) {
            const double value = json_->get<double>();
            if (value >= 0.0 && value < most && value == std::floor(value))
                return static_cast<std::size_t>(value);
        }
        fail("is no whole number of at least 0");
    }
    [[nodiscard]] std::size_t whole_number_or(std::size_t otherwise) const {
        return json_ == nullptr ? otherwise : whole_number();
    }

    /// The number of one of `count` items, which are called `what`; -1 if it is not there.
    [[nodiscard]] int number_of(std::size_t count, const char* what) const {
        if (json_ == nullptr) return -1;
        const std::size_t number = whole_number();
        if (number >= count)
            fail("is " + std::to_string(number) + ", but there are " + std::to_string(count) + " " + what);
        return static_cast<int>(number);
    }
    [[nodiscard]] int required_number_of(std::size_t count, const char* what) const {
        if (json_ == nullptr) fail("is missing");
        return number_of(count, what);
    }

    [[nodiscard]] double number() const {
        if (json_ == nullptr || !json_->is_number()) fail("is no number");
        return json_->get<double>();
    }
    [[nodiscard]] bool flag() const {
        if (json_ == nullptr) return false;
        if (!json_->is_boolean()) fail("is neither true nor false");
        return json_->get<bool>();
    }
    [[nodiscard]] const std::string& text() const {
        if (json_ == nullptr || !json_->is_string()) fail("is no text");
        return json_->get_ref<const std::string&>();
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw Error(ExitCode::input,
                    *path_ + ": the file is damaged: " + way() + " " + what + "; export the mesh again");
    }

  private:
    GltfValue(const nlohmann::json* json, const GltfValue& parent, const char* key, std::size_t index)
        : json_(json), path_(parent.path_), parent_(&parent), key_(key), index_(index) {}

    /// "meshes[3].primitives[0]".
    [[nodiscard]] std::string way() const {
        if (parent_ == nullptr) return "its JSON";
        const std::string before = parent_->parent_ == nullptr ? "" : parent_->way();
        if (key_ == nullptr) return before + "[" + std::to_string(index_) + "]";
        return before.empty() ? key_ : before + "." + key_;
    }

    const nlohmann::json* json_;
    const std::string* path_;
    const GltfValue* parent_ = nullptr;  ///< outlives this one, which is made of it
    const char* key_ = nullptr;
    std::size_t index_ = 0;
};

using NamedValue = std::pair<const char*, int>;

constexpr std::array<NamedValue, 7> accessor_types{
    {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 0}, {"MAT3", 0}, {"MAT4", 0}}};

/// Extensions that say how data are compressed.
constexpr std::array<const char*, 3> compressions{"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                                  "KHR_meshopt_compression"};

/// How the names of extensions begin that change looks only, or integers as coordinates, which are read.
constexpr std::array<const char*, 8> harmless_extensions{
    "KHR_materials_", "KHR_texture_", "KHR_lights_",   "KHR_mesh_quantization",
    "EXT_texture_",   "EXT_lights_",  "MSFT_texture_", "KHR_xmp"};

[[noreturn]] void refuse_compression(const std::string& path, const std::string& extension) {
    throw Error(ExitCode::input, path + ": the mesh is compressed with " + extension +
                                     ", which is not read; save it without compression");
}

bool is_compression(std::string_view extension) {
    return std::find(compressions.begin(), compressions.end(), extension) != compressions.end();
}

void check_extensions(const GltfValue& document, const std::string& path) {
    const GltfValue required = document["extensionsRequired"];
    for (std::size_t k = 0; k < required.size(); ++k) {
        const std::string& name = required.element(k).text();
        if (is_compression(name)) refuse_compression(path, name);
        const bool is_harmless = std::any_of(harmless_extensions.begin(), harmless_extensions.end(),
                                             [&](const char* begin) { return name.starts_with(begin); });
        if (is_harmless) continue;
        throw Error(ExitCode::input, path + ": needs the extension " + in_quotes(name) +
                                         ", which is not read; export the mesh without it");
    }
}

void check_version(const GltfValue& document, const std::string& path) {
    const GltfValue asset = document["asset"];
    const GltfValue version = asset["version"];
    if (!version.is_there())
        throw Error(
            ExitCode::input,
            path + ": the JSON has no asset.version as that of a glTF file has; export the mesh again");
    if (version.text().starts_with("2.") || version.text() == "2") return;
    throw Error(ExitCode::input, path + ": is glTF of version " + in_quotes(version.text()) +
                                     ", but only version 2 is read; export the mesh as glTF 2.0");
}

/// Reads the records one after the other; later ones refer to earlier ones.
class GltfAssetReader {
  public:
    GltfAssetReader(const GltfContainer& container, const GltfValue& document, const std::string& path)
        : container_(container), document_(document) {
        asset_.path = path;
    }

    GltfAsset run() {
        read_buffers();
        read_views();
        read_accessors();
        read_meshes();
        read_nodes();
        read_scene();
        return std::move(asset_);
    }

  private:
    void read_buffers() {
        const GltfValue list = document_["buffers"];
        std::size_t files = 0;
        for (std::size_t k = 0; k < list.size(); ++k) {
            const GltfValue buffer = list.element(k);
            for (const char* extension : compressions) {
                if (buffer["extensions"][extension].is_there()) refuse_compression(asset_.path, extension);
            }
            const std::string_view bytes = bytes_of(buffer, k, files);
            const std::size_t length = buffer["byteLength"].whole_number();
            if (length > bytes.size())
                buffer.fail("should have " + std::to_string(length) + " bytes, but there are " +
                            std::to_string(bytes.size()));
            asset_.buffers.push_back(bytes.substr(0, length));
        }
    }

    std::string_view bytes_of(const GltfValue& buffer, std::size_t number, std::size_t& files) {
        const GltfValue uri = buffer["uri"];
        if (!uri.is_there()) return number == 0 ? container_.binary : std::string_view{};
        const std::string& text = uri.text();
        if (!text.starts_with("data:")) {
            if (files >= container_.buffer_files.size())
                uri.fail("is the file " + in_quotes(text) + ", which was not read");
            return container_.buffer_files[files++];
        }
        constexpr std::string_view mark = ";base64,";
        const std::size_t place = text.find(mark);
        std::optional<std::vector<char>> bytes;
        if (place != std::string::npos)
            bytes = bytes_of_base64(std::string_view(text).substr(place + mark.size()));
        if (!bytes) uri.fail("is no text in base64");
        asset_.decoded.push_back(std::move(*bytes));
        return {asset_.decoded.back().data(), asset_.decoded.back().size()};
    }

    void read_views() {
        const GltfValue list = document_["bufferViews"];
        for (std::size_t k = 0; k < list.size(); ++k) {
            const GltfValue value = list.element(k);
            GltfView view;
            view.buffer = value["buffer"].required_number_of(asset_.buffers.size(), "buffers");
            view.offset = value["byteOffset"].whole_number_or(0);
            view.length = value["byteLength"].whole_number();
            view.stride = value["byteStride"].whole_number_or(0);
            const std::size_t size = asset_.buffers[at(view.buffer)].size();
            if (view.offset > size || view.length > size - view.offset) {
                value.fail("takes " + std::to_string(view.length) + " bytes from byte " +
                           std::to_string(view.offset) + " of a buffer of " + std::to_string(size));
            }
            asset_.views.push_back(view);
        }
    }

    static int component_type_of(const GltfValue& value) {
        const std::size_t type = value.whole_number();
        if (type > 10000 || component_size(static_cast<int>(type)) == 0) value.fail("is no type of numbers");
        return static_cast<int>(type);
    }

    static int components_of(const GltfValue& value) {
        const std::string& name = value.text();
        for (const auto& [known, components] : accessor_types) {
            if (name == known) return components;
        }
        value.fail("is no type of vectors");
    }

    [[nodiscard]] std::optional<GltfSparse> sparse_of(const GltfValue& value) const {
        if (!value.is_there()) return std::nullopt;
        const GltfValue indices = value["indices"];
        const GltfValue values = value["values"];
        GltfSparse sparse;
        sparse.count = value["count"].whole_number();
        sparse.index_view = indices["bufferView"].required_number_of(asset_.views.size(), "buffer views");
        sparse.index_offset = indices["byteOffset"].whole_number_or(0);
        sparse.index_type = component_type_of(indices["componentType"]);
        sparse.value_view = values["bufferView"].required_number_of(asset_.views.size(), "buffer views");
        sparse.value_offset = values["byteOffset"].whole_number_or(0);
        return sparse;
    }

    void read_accessors() {
        const GltfValue list = document_["accessors"];
        for (std::size_t k = 0; k < list.size(); ++k) {
            const GltfValue value = list.element(k);
            GltfAccessor accessor;
            accessor.view = value["bufferView"].number_of(asset_.views.size(), "buffer views");
            accessor.offset = value["byteOffset"].whole_number_or(0);
            accessor.component_type = component_type_of(value["componentType"]);
            accessor.is_normalized = value["normalized"].flag();
            accessor.count = value["count"].whole_number();
            accessor.components = components_of(value["type"]);
            accessor.sparse = sparse_of(value["sparse"]);
            asset_.accessors.push_back(accessor);
        }
    }

    [[nodiscard]] GltfPrimitive primitive_of(const GltfValue& value) const {
        GltfPrimitive primitive;
        const GltfValue mode = value["mode"];
        const std::size_t number = mode.whole_number_or(static_cast<std::size_t>(GltfMode::triangles));
        if (number > static_cast<std::size_t>(GltfMode::triangle_fan)) mode.fail("is no kind of primitives");
        primitive.mode = static_cast<GltfMode>(number);
        const std::size_t accessors = asset_.accessors.size();
        primitive.positions = value["attributes"]["POSITION"].number_of(accessors, "accessors");
        primitive.indices = value["indices"].number_of(accessors, "accessors");
        for (const char* extension : compressions) {
            if (value["extensions"][extension].is_there()) primitive.compression = extension;
        }
        return primitive;
    }

    void read_meshes() {
        const GltfValue list = document_["meshes"];
        for (std::size_t k = 0; k < list.size(); ++k) {
            const GltfValue mesh = list.element(k);
            const GltfValue primitives = mesh["primitives"];
            asset_.meshes.emplace_back();
            for (std::size_t i = 0; i < primitives.size(); ++i)
                asset_.meshes.back().push_back(primitive_of(primitives.element(i)));
        }
    }

    /// `count` numbers into `values`, which stay as they are if the list is not there.
    static void read_numbers(const GltfValue& list, double* values, std::size_t count) {
        if (!list.is_there()) return;
        if (list.size() != count) list.fail("has " + std::to_string(list.size()) + " numbers");
        for (std::size_t k = 0; k < count; ++k) values[k] = list.element(k).number();
    }

    static Eigen::Matrix4d to_parent_of(const GltfValue& node) {
        Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
        if (node["matrix"].is_there()) {
            read_numbers(node["matrix"], matrix.data(), 16);  // by columns, as Eigen has it
            return matrix;
        }
        Eigen::Vector3d translation = Eigen::Vector3d::Zero();
        Eigen::Vector3d scale = Eigen::Vector3d::Ones();
        Eigen::Vector4d turn(0.0, 0.0, 0.0, 1.0);
        read_numbers(node["translation"], translation.data(), 3);
        read_numbers(node["scale"], scale.data(), 3);
        read_numbers(node["rotation"], turn.data(), 4);
        const double length = turn.norm();
        if (length > 0.0) turn /= length;
        matrix.topLeftCorner<3, 3>() =
            Eigen::Quaterniond(turn).toRotationMatrix() * scale.asDiagonal().toDenseMatrix();
        matrix.topRightCorner<3, 1>() = translation;
        return matrix;
    }

    void read_nodes() {
        const GltfValue list = document_["nodes"];
        for (std::size_t k = 0; k < list.size(); ++k) {
            const GltfValue value = list.element(k);
            GltfNode node;
            node.mesh = value["mesh"].number_of(asset_.meshes.size(), "meshes");
            node.skin = value["skin"].number_of(document_["skins"].size(), "skins");
            const GltfValue children = value["children"];
            for (std::size_t i = 0; i < children.size(); ++i)
                node.children.push_back(children.element(i).required_number_of(list.size(), "nodes"));
            node.to_parent = to_parent_of(value);
            asset_.nodes.push_back(std::move(node));
        }
    }

    void read_scene() {
        const GltfValue scenes = document_["scenes"];
        asset_.scene = document_["scene"].number_of(scenes.size(), "scenes");
        if (asset_.scene < 0 && scenes.size() > 0) asset_.scene = 0;
        if (asset_.scene < 0) {
            asset_.roots = nodes_without_parent();
            return;
        }
        const GltfValue scene = scenes.element(at(asset_.scene));
        const GltfValue nodes = scene["nodes"];
        for (std::size_t k = 0; k < nodes.size(); ++k)
            asset_.roots.push_back(nodes.element(k).required_number_of(asset_.nodes.size(), "nodes"));
    }

    [[nodiscard]] std::vector<int> nodes_without_parent() const {
        std::vector<char> has_parent(asset_.nodes.size(), 0);
        for (const GltfNode& node : asset_.nodes) {
            for (const int child : node.children) has_parent[at(child)] = 1;
        }
        std::vector<int> nodes;
        for (std::size_t k = 0; k < has_parent.size(); ++k) {
            if (has_parent[k] == 0) nodes.push_back(static_cast<int>(k));
        }
        return nodes;
    }

    GltfAsset asset_;
    const GltfContainer& container_;
    const GltfValue& document_;
};

}  // namespace

std::size_t component_size(int component_type) {
    switch (component_type) {
        case 5120:
        case 5121:
            return 1;
        case 5122:
        case 5123:
            return 2;
        case 5125:
        case 5126:
            return 4;
        default:
            return 0;
    }
}

GltfAsset read_gltf_asset(const GltfContainer& container, const std::string& path) {
    check_json_depth(container.json, path);
    nlohmann::json json;
    try {
        json = nlohmann::json::parse(container.json);
    } catch (const nlohmann::json::parse_error& error) {
        throw Error(ExitCode::input, path + ": the JSON of the file cannot be read beyond its byte " +
                                         std::to_string(error.byte) + "; export the mesh again");
    } catch (const nlohmann::json::exception&) {
        throw Error(ExitCode::input,
                    path + ": the JSON of the file holds a number that is too large; export the mesh again");
    }
    const GltfValue document(json, path);
    check_version(document, path);
    check_extensions(document, path);
    return GltfAssetReader(container, document, path).run();
}

}  // namespace coseg
