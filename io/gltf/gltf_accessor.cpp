#include "io/gltf/gltf_accessor.hpp"

#include <algorithm>
#include <limits>

#include "io/files/byte_cursor.hpp"
#include "src/base/error.hpp"
#include "src/base/index.hpp"

namespace coseg {

namespace {

/// The largest element, of four components of four bytes.
constexpr std::string_view zeros("\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0", 16);

[[noreturn]] void refuse_accessor(const GltfAsset& asset, const std::string& name, const std::string& what) {
    throw Error(ExitCode::input,
                asset.path + ": the file is damaged: " + name + " " + what + "; export the mesh again");
}

/// `count` elements of `size` bytes, `stride` apart, from `offset` in a view on.
struct GltfRange {
    int view;
    std::size_t offset;
    std::size_t count;
    std::size_t size;
    std::size_t stride;
};

/// The bytes from the first element on.
std::string_view checked_bytes(const GltfAsset& asset, const GltfRange& range, const std::string& name) {
    const GltfView& view = asset.views[at(range.view)];
    const std::string_view bytes = asset.buffers[at(view.buffer)].substr(view.offset, view.length);
    if (range.stride < range.size) refuse_accessor(asset, name, "has elements that lie over each other");
    const std::size_t room = range.offset > bytes.size() ? 0 : bytes.size() - range.offset;
    const bool fits =
        range.count == 0 || (range.size <= room && range.count - 1 <= (room - range.size) / range.stride);
    if (!fits) {
        refuse_accessor(asset, name,
                        "has " + std::to_string(range.count) + " elements from byte " +
                            std::to_string(range.offset) + " of a buffer view of " +
                            std::to_string(bytes.size()) + " bytes on, which ends before them");
    }
    return bytes.substr(std::min(range.offset, bytes.size()));
}

template <typename T>
T component_at(std::string_view bytes) {
    T value{};
    ByteCursor(bytes, 0, false).read(value);
    return value;
}

template <typename T>
double whole_component(std::string_view bytes, bool is_normalized) {
    const auto value = static_cast<double>(component_at<T>(bytes));
    if (!is_normalized) return value;
    return std::max(value / static_cast<double>(std::numeric_limits<T>::max()), -1.0);
}

double component_of(std::string_view bytes, int type, bool is_normalized) {
    switch (type) {
        case 5120:
            return whole_component<std::int8_t>(bytes, is_normalized);
        case 5121:
            return whole_component<std::uint8_t>(bytes, is_normalized);
        case 5122:
            return whole_component<std::int16_t>(bytes, is_normalized);
        case 5123:
            return whole_component<std::uint16_t>(bytes, is_normalized);
        case 5125:
            return whole_component<std::uint32_t>(bytes, is_normalized);
        default:
            return static_cast<double>(component_at<float>(bytes));
    }
}

std::uint32_t index_of(std::string_view bytes, int type) {
    if (type == 5121) return component_at<std::uint8_t>(bytes);
    if (type == 5123) return component_at<std::uint16_t>(bytes);
    return component_at<std::uint32_t>(bytes);
}

}  // namespace

bool has_elements(const GltfAccessor& accessor) { return accessor.view >= 0 || accessor.sparse.has_value(); }

std::size_t most_elements(const GltfAsset& asset) {
    constexpr std::size_t of_any_file = 3'000'000;
    constexpr std::size_t per_byte = 64;
    std::size_t bytes = 0;
    for (const std::string_view buffer : asset.buffers) bytes += buffer.size();
    return std::max(of_any_file, per_byte * bytes);
}

GltfElements::GltfElements(const GltfAsset& asset, int accessor)
    : accessor_(&asset.accessors[at(accessor)]),
      size_(at(accessor_->components) * component_size(accessor_->component_type)) {
    const std::string name = "accessors[" + std::to_string(accessor) + "]";
    if (accessor_->components == 0) refuse_accessor(asset, name, "holds matrices");
    if (!has_elements(*accessor_)) refuse_accessor(asset, name, "has no bufferView");
    if (accessor_->view >= 0) {
        const std::size_t stride = asset.views[at(accessor_->view)].stride;
        stride_ = stride == 0 ? size_ : stride;
        bytes_ = checked_bytes(asset, {accessor_->view, accessor_->offset, accessor_->count, size_, stride_},
                               name);
    } else if (accessor_->count > most_elements(asset)) {
        refuse_accessor(asset, name,
                        "has " + std::to_string(accessor_->count) +
                            " elements without bytes, too many for a file of its size");
    }
    if (accessor_->sparse) read_sparse(asset, name);
}

void GltfElements::read_sparse(const GltfAsset& asset, const std::string& name) {
    const GltfSparse& sparse = *accessor_->sparse;
    const std::size_t index_size = component_size(sparse.index_type);
    const std::string_view indices =
        checked_bytes(asset, {sparse.index_view, sparse.index_offset, sparse.count, index_size, index_size},
                      name + ".sparse.indices");
    replacements_ = checked_bytes(asset, {sparse.value_view, sparse.value_offset, sparse.count, size_, size_},
                                  name + ".sparse.values");
    for (std::size_t k = 0; k < sparse.count; ++k) {
        const std::uint32_t index = index_of(indices.substr(k * index_size), sparse.index_type);
        if (index >= accessor_->count || (!replaced_.empty() && index <= replaced_.back()))
            refuse_accessor(asset, name + ".sparse.indices", "do not ascend below the number of elements");
        replaced_.push_back(index);
    }
}

std::string_view GltfElements::bytes(std::size_t element) const {
    const auto found = std::lower_bound(replaced_.begin(), replaced_.end(), element);
    if (found != replaced_.end() && *found == element)
        return replacements_.substr(static_cast<std::size_t>(found - replaced_.begin()) * size_, size_);
    if (accessor_->view < 0) return zeros.substr(0, size_);
    return bytes_.substr(element * stride_, size_);
}

double GltfElements::real(std::size_t element, int component) const {
    const std::size_t place = at(component) * component_size(accessor_->component_type);
    return component_of(bytes(element).substr(place), accessor_->component_type, accessor_->is_normalized);
}

std::uint32_t GltfElements::index(std::size_t element) const {
    return index_of(bytes(element), accessor_->component_type);
}

}  // namespace coseg
