// A raster's cells as an OpenCV matrix, without a copy. For the few files that use OpenCV.
#pragma once

#include <opencv2/core/mat.hpp>

#include "perception/raster.h"

namespace gramap {

template <typename T>
cv::Mat matrix(Raster<T>& raster) {
  return {raster.rows, raster.columns, cv::DataType<T>::type, raster.cells.data()};
}
template <typename T>
cv::Mat matrix(const Raster<T>& raster) {  // read only by agreement: cv::Mat knows no const
  return {raster.rows, raster.columns, cv::DataType<T>::type, const_cast<T*>(raster.cells.data())};
}

}  // namespace gramap
