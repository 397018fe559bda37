# OpenCV's core, imgproc and ml. Debian's OpenCVConfig.cmake comes only with the full libopencv-dev; with the three small
# -dev packages alone there are headers and libraries, and this finds them either way.
find_path(OpenCV_INCLUDE_DIR opencv2/core.hpp PATH_SUFFIXES opencv4)
set(OpenCV_LIBRARIES)
foreach(module core imgproc ml)
  find_library(OpenCV_${module}_LIBRARY opencv_${module})
  list(APPEND OpenCV_LIBRARIES ${OpenCV_${module}_LIBRARY})
endforeach()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenCV REQUIRED_VARS OpenCV_INCLUDE_DIR OpenCV_core_LIBRARY OpenCV_imgproc_LIBRARY OpenCV_ml_LIBRARY)

if(OpenCV_FOUND AND NOT TARGET OpenCV::OpenCV)
  add_library(OpenCV::OpenCV INTERFACE IMPORTED)
  target_include_directories(OpenCV::OpenCV SYSTEM INTERFACE ${OpenCV_INCLUDE_DIR})
  target_link_libraries(OpenCV::OpenCV INTERFACE ${OpenCV_LIBRARIES})
endif()
