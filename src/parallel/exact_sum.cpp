#include "src/parallel/exact_sum.hpp"

#include <algorithm>
#include <array>
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

constexpr unsigned limb_bits = 32;
constexpr int smallest_exponent = 1074;  // the least double is 2^-1074

void carry(std::span<std::int64_t> limbs) {
    for (std::size_t k = 0; k + 1 < limbs.size(); ++k) {
        const std::int64_t over = limbs[k] >> limb_bits;
        limbs[k] -= over << limb_bits;
        limbs[k + 1] += over;
    }
}

/// `first`: the number of the lowest limb among those that cover all of double.
double round_limbs(std::span<std::int64_t> limbs, std::size_t first) {
    carry(limbs);
    const bool negative = limbs.back() < 0;
    if (negative) {
        for (std::int64_t& limb : limbs) limb = -limb;
        carry(limbs);
    }
    double sum = 0.0;
    for (std::size_t k = limbs.size(); k-- > 0;) {
        if (limbs[k] == 0) continue;
        sum += std::ldexp(static_cast<double>(limbs[k]),
                          static_cast<int>(limb_bits * (first + k)) - smallest_exponent);
    }
    return negative ? -sum : sum;
}

}  // namespace

ExactSum::ExactSum(std::size_t field_size, double field_scale, std::size_t scalars)
    : exponent_(std::ilogb(field_scale) + 1),
      ticks_per_unit_(std::ldexp(1.0, fraction_bits - exponent_)),
      largest_addend_(std::ldexp(1.0, range_bits + exponent_)) {
    set_sizes(field_size, scalars);
}

ExactSum::ExactSum(std::size_t scalars, LimbRange range) : ExactSum(0, 1.0, 0) {
    range_ = range;
    set_sizes(0, scalars);
}

ExactSum ExactSum::of_order_one(std::size_t scalars) { return {scalars, {.first = 28, .count = 8}}; }

void ExactSum::set_sizes(std::size_t field_size, std::size_t scalars) {
    ticks_.assign(field_size, 0);
    limbs_.assign(scalars * range_.count, 0);
    message_.assign(1 + 2 * field_size + limbs_.size(), 0);
    field_.assign(field_size, 0.0);
    scalars_.assign(scalars, 0.0);
}

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

/// Adds the 53-bit mantissa of `value` at its place, in three limbs: 53 bits and a shift of at most 31 are
/// fewer than 96. A limb overflows after 2^31 addends at the earliest.
void ExactSum::add_limbs(std::size_t index, double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const auto biased = static_cast<unsigned>((bits >> 52U) & 0x7ffU);
    const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52U) - 1);
    const std::uint64_t mantissa = fraction | static_cast<std::uint64_t>(biased != 0) << 52U;
    const unsigned place = biased == 0 ? 0 : biased - 1;
    const unsigned shift = place % limb_bits;
    const std::uint64_t low = mantissa << shift;
    const std::uint64_t high = mantissa >> 1U >> (63U - shift);  // a shift by 64 is not defined
    const std::array<std::uint64_t, 3> digits{low & 0xffffffffU, low >> 32U, high};
    const std::int64_t sign = (bits >> 63U) != 0 ? -1 : 1;
    std::int64_t* const limbs = limbs_.data() + index * range_.count;
    const std::size_t first = place / limb_bits;
    if (first >= range_.first && first + digits.size() <= range_.first + range_.count) {
        std::int64_t* const at_place = limbs + (first - range_.first);
        for (std::size_t k = 0; k < digits.size(); ++k)
            at_place[k] += sign * static_cast<std::int64_t>(digits[k]);
        return;
    }
    for (std::size_t k = 0; k < digits.size(); ++k) {
        const std::size_t limb = first + k;
        if (digits[k] == 0 || limb < range_.first) continue;
        if (limb >= range_.first + range_.count) {
            addend_overflowed_ = true;
        } else {
            limbs[limb - range_.first] += sign * static_cast<std::int64_t>(digits[k]);
        }
    }
}

void ExactSum::add_scalar(std::size_t index, double value) {
    if (!std::isfinite(value)) {
        addend_overflowed_ = true;
        return;
    }
    add_limbs(index, value);
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
        scalars_[k] = round_limbs(limbs.subspan(k * range_.count, range_.count), range_.first);
    }
}

void ExactSum::reduce(MPI_Comm comm) {
    pack();
    in_messages(std::ssize(message_), [&](std::int64_t first, int count) {
        MPI_Allreduce(MPI_IN_PLACE, message_.data() + first, count, MPI_INT64_T, MPI_SUM, comm);
    });
    unpack();
}

}  // namespace coseg
