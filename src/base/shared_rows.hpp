#pragma once
#include <algorithm>
#include <vector>

#include "base/field.hpp"
#include "base/loops.hpp"

namespace livebed::base {

/// A field most of whose rows are alike: equal rows are stored once.  A loop over rows then reads one row of ones from
/// the cache again and again instead of a whole field of ones from memory.
class SharedRows {
public:
  SharedRows() = default;
  /// The rows of f, ghosts included.
  explicit SharedRows(const Field& f) { keep(f); }
  /// The same in the memory that is there, if it is enough.
  void keep(const Field& f) {
    index_.assign(static_cast<std::size_t>(f.ny()) + 2 * ghosts, 0);
    std::vector<int> kept;
    const int ga = -ghosts, gb = f.nx() + ghosts;
    for (int j = -ghosts; j < f.ny() + ghosts; ++j) {
      const auto equal = [&](int k) { return std::equal(f.row(j) + ga, f.row(j) + gb, f.row(kept[k]) + ga); };
      const int last = static_cast<int>(kept.size()) - 1;
      int& mine = index_[j + ghosts];
      if (last >= 0 && equal(last))
        mine = last;
      else if (last >= 0 && equal(0))
        mine = 0;
      else
        mine = last + 1, kept.push_back(j);
    }
    if (rows_.nx() != f.nx() || rows_.ny() < static_cast<int>(kept.size()))
      rows_ = Field(f.nx(), static_cast<int>(kept.size()), ghosts);
    one_.assign(kept.size(), 0);
    for_each_item(0, static_cast<int>(kept.size()), [&](int k) {
      const double *first = f.row(kept[k]) + ga, *last = f.row(kept[k]) + gb;
      std::copy(first, last, rows_.row(k) + ga);
      one_[k] = std::all_of(first, last, [](double v) { return v == 1.0; });
    });
  }
  /// `value` all over, but with rows of their own, to be written at any time, where own[j] is set.
  SharedRows(int nx, const std::vector<char>& own, double value) : SharedRows(static_cast<int>(own.size())) {
    int count = 1;
    for (std::size_t j = 0; j < own.size(); ++j)
      if (own[j]) index_[j + ghosts] = count++;
    rows_ = Field(nx, count, ghosts, value);
    one_.assign(count, 0);
  }

  const double* row(int j) const { return rows_.row(index_[j + ghosts]); }
  double operator()(int i, int j) const { return row(j)[i]; }

  /// Whether row j is 1 all over, so that a factor may be left out.
  bool is_one(int j) const { return one_[index_[j + ghosts]] != 0; }

  /// Row j to be written; only rows that were made with their own.
  bool owns(int j) const { return index_[j + ghosts] > 0; }
  double* own_row(int j) { return rows_.row(index_[j + ghosts]); }

private:
  static constexpr int ghosts = 2;
  explicit SharedRows(int ny) : index_(static_cast<std::size_t>(ny) + 2 * ghosts, 0) {}
  Field rows_;
  std::vector<int> index_;  ///< of the stored row that stands for each row, ghosts first
  std::vector<char> one_;   ///< of each stored row
};

}  // namespace livebed::base
