#include "src/parallel/exact_sum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "src/base/index.hpp"

namespace coseg {

namespace {

constexpr int fraction_bits = 80;
constexpr int range_bits = 12;
constexpr int low_bits = 45;  // 2^45 times the number of ranks fits in 63 bits
constexpr std::int64_t low_mask = (std::int64_t{1} << low_bits) - 1;

constexpr int limb_bits = 32;
constexpr int smallest_exponent = 1074;  // the least double is 2^-1074
constexpr std::size_t limbs_per_scalar = 68;

/// Adds the 53-bit mantissa of `value` at its place; a limb overflows after 2^31 addends at the earliest.
void add_exactly(std::span<std::int64_t> limbs, double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const int biased = static_cast<int>((bits >> 52U) & 0x7ffU);
    std::uint64_t mantissa = bits & ((std::uint64_t{1} << 52U) - 1);
    if (biased != 0) mantissa |= std::uint64_t{1} << 52U;
    const int place = biased == 0 ? 0 : biased - 1;
    const auto first = at(place / limb_bits);
    __extension__ typedef unsigned __int128 Wide;  // NOLINT(modernize-use-using)
    Wide shifted = static_cast<Wide>(mantissa) << (place % limb_bits);
    const bool negative = (bits >> 63U) != 0;
    for (std::size_t k = first; shifted != 0; ++k, shifted >>= limb_bits) {
        const auto digit = static_cast<std::int64_t>(static_cast<std::uint32_t>(shifted));
        limbs[k] += negative ? -digit : digit;
    }
}

void carry(std::span<std::int64_t> limbs) {
    for (std::size_t k = 0; k + 1 < limbs.size(); ++k) {
        const std::int64_t over = limbs[k] >> limb_bits;
        limbs[k] -= over << limb_bits;
        limbs[k + 1] += over;
    }
}

double round_limbs(std::span<std::int64_t> limbs) {
    carry(limbs);
    const bool negative = limbs.back() < 0;
    if (negative) {
        for (std::int64_t& limb : limbs) limb = -limb;
        carry(limbs);
    }
    double sum = 0.0;
    for (std::size_t k = limbs.size(); k-- > 0;) {
        if (limbs[k] == 0) continue;
        sum += std::ldexp(static_cast<double>(limbs[k]), limb_bits * static_cast<int>(k) - smallest_exponent);
    }
    return negative ? -sum : sum;
}

}  // namespace

ExactSum::ExactSum(std::size_t field_size, double field_scale, std::size_t scalars)
    : exponent_(std::ilogb(field_scale) + 1),
      ticks_per_unit_(std::ldexp(1.0, fraction_bits - exponent_)),
      largest_addend_(std::ldexp(1.0, range_bits + exponent_)),
      ticks_(field_size, 0),
      limbs_(scalars * limbs_per_scalar, 0),
      message_(1 + 2 * field_size + limbs_.size(), 0),
      field_(field_size, 0.0),
      scalars_(scalars, 0.0) {}

void ExactSum::clear() {
    std::fill(ticks_.begin(), ticks_.end(), Ticks{0});
    std::fill(limbs_.begin(), limbs_.end(), std::int64_t{0});
    addend_overflowed_ = false;
}

void ExactSum::add_field(std::size_t index, double value) {
    if (!(std::abs(value) <= largest_addend_)) {
        addend_overflowed_ = true;
        return;
    }
    ticks_[index] += static_cast<Ticks>(value * ticks_per_unit_);
}

void ExactSum::add_scalar(std::size_t index, double value) {
    if (!std::isfinite(value)) {
        addend_overflowed_ = true;
        return;
    }
    add_exactly(std::span(limbs_).subspan(index * limbs_per_scalar, limbs_per_scalar), value);
}

void ExactSum::pack() {
    // A rank's own part is cut off at the limits, so that the message cannot overflow.
    const Ticks limit = Ticks{1} << (fraction_bits + range_bits);
    message_[0] = addend_overflowed_ ? 1 : 0;
    for (std::size_t i = 0; i < ticks_.size(); ++i) {
        const Ticks part = std::clamp(ticks_[i], -limit, limit);
        message_[1 + 2 * i] = static_cast<std::int64_t>(part >> low_bits);
        message_[2 + 2 * i] = static_cast<std::int64_t>(part) & low_mask;
    }
    std::copy(limbs_.begin(), limbs_.end(),
              message_.begin() + static_cast<std::ptrdiff_t>(1 + 2 * ticks_.size()));
}

void ExactSum::unpack() {
    overflowed_ = message_[0] != 0;
    const Ticks limit = Ticks{1} << (fraction_bits + range_bits);
    const double unit = std::ldexp(1.0, exponent_ - fraction_bits);
    for (std::size_t i = 0; i < ticks_.size(); ++i) {
        const Ticks total = (static_cast<Ticks>(message_[1 + 2 * i]) << low_bits) + message_[2 + 2 * i];
        if (total >= limit || total <= -limit) overflowed_ = true;
        field_[i] = static_cast<double>(total) * unit;
    }
    const std::span<std::int64_t> limbs = std::span(message_).subspan(1 + 2 * ticks_.size());
    for (std::size_t k = 0; k < scalars_.size(); ++k) {
        scalars_[k] = round_limbs(limbs.subspan(k * limbs_per_scalar, limbs_per_scalar));
    }
}

void ExactSum::reduce(const Comm& comm) {
    pack();
    in_messages(std::ssize(message_), [&](std::int64_t first, int count) {
        MPI_Allreduce(MPI_IN_PLACE, message_.data() + first, count, MPI_INT64_T, MPI_SUM, comm.raw());
    });
    unpack();
}

}  // namespace coseg
