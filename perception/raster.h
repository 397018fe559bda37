// A grid of values over a plane: column by row, row 0 at the bottom.
#pragma once

#include <cstddef>
#include <vector>

namespace gramap {

template <typename T>
struct Raster {
  int columns = 0, rows = 0;
  std::vector<T> cells;  ///< row by row

  Raster() = default;
  Raster(int columns_, int rows_, T value = {})
      : columns(columns_),
        rows(rows_),
        cells(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), value) {}
  T& at(int column, int row) { return cells[index(column, row)]; }
  const T& at(int column, int row) const { return cells[index(column, row)]; }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

}  // namespace gramap
