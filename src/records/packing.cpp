#include "src/records/packing.hpp"

#include <cstring>

#include "src/base/error.hpp"

namespace coseg {

void Packer::append(const void* data, std::size_t size) {
    const auto* first = static_cast<const std::byte*>(data);
    if (size > 0) bytes_.insert(bytes_.end(), first, first + size);
}

void Unpacker::copy_to(void* data, std::size_t size) {
    if (size > rest_.size()) refuse();
    if (size > 0) std::memcpy(data, rest_.data(), size);
    rest_ = rest_.subspan(size);
}

void Unpacker::refuse() { throw Error(ExitCode::internal, "a packed record ends before its last field"); }

}  // namespace coseg
