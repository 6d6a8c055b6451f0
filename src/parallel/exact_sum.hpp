#pragma once
// Sums over ranks that have the same bits on any number of ranks, in one reduction.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/parallel/comm.hpp"

namespace coseg {

/// A field of many sums of one order of magnitude (the row sums of W) and a few scalars of any (the
/// objective), reduced together.
///
/// The field is kept as integers: multiples of 2^-80 times the power of two above `field_scale`, 16 bytes a
/// sum. Addends are rounded towards zero to such a multiple, and a sum beyond 2^12 times that power makes
/// `overflowed()` true. The scalars are summed exactly over the whole range of double, in 544 bytes each, and
/// rounded at the end. Neither the order of addition nor the number of ranks shows in either.
class ExactSum {
  public:
    /// `field_size` sums of order `field_scale` (> 0; the same on every rank) and `scalars` scalars.
    ExactSum(std::size_t field_size, double field_scale, std::size_t scalars);
    /// Sums of scalars only.
    explicit ExactSum(std::size_t scalars) : ExactSum(0, 1.0, scalars) {}
    /// Scalars only, for many sums of order 1 that are often reduced, such as inner products of unit vectors:
    /// 64 bytes a scalar. What an addend has below 2^-178 is cut off, and one beyond 2^77 makes overflowed()
    /// true.
    static ExactSum of_order_one(std::size_t scalars);

    void clear();
    void add_field(std::size_t index, double value);
    void add_scalar(std::size_t index, double value);

    /// One reduction over the ranks. Collective; every rank must have been given the same sizes and scale.
    void reduce(const Comm& comm) { reduce(comm.raw()); }
    void reduce(MPI_Comm comm);

    /// Valid after reduce(), on all ranks.
    [[nodiscard]] const std::vector<double>& field() const noexcept { return field_; }
    [[nodiscard]] double scalar(std::size_t index) const noexcept { return scalars_[index]; }
    [[nodiscard]] const std::vector<double>& scalars() const noexcept { return scalars_; }
    /// True if a sum left its range or an addend was not finite.
    [[nodiscard]] bool overflowed() const noexcept { return overflowed_; }

  private:
    __extension__ typedef __int128 Ticks;  // NOLINT(modernize-use-using): an alias cannot be an extension
    /// The limbs that are kept of a scalar: signed digits of 32 bits, of 68 that cover all of double.
    struct LimbRange {
        std::size_t first = 0;
        std::size_t count = 68;
    };
    ExactSum(std::size_t scalars, LimbRange range);
    void set_sizes(std::size_t field_size, std::size_t scalars);
    void add_limbs(std::size_t index, double value);
    void pack();
    void unpack();

    int exponent_;
    double ticks_per_unit_;
    double largest_addend_;
    bool addend_overflowed_ = false;
    std::vector<Ticks> ticks_;
    LimbRange range_;
    std::vector<std::int64_t> limbs_;    ///< per scalar range_.count
    std::vector<std::int64_t> message_;  ///< overflow count, then high and low words of the field, then limbs
    std::vector<double> field_;
    std::vector<double> scalars_;
    bool overflowed_ = false;
};

}  // namespace coseg
