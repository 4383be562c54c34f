# Through pkg-config: Debian's OpenImageIOConfig.cmake also insists on OpenImageIO's command-line
# tools and on OpenCV's headers, neither of which Gnomon uses.
if(NOT TARGET OpenImageIO::OpenImageIO)
  pkg_check_modules(openimageio REQUIRED IMPORTED_TARGET GLOBAL OpenImageIO>=2.4 Imath)
  add_library(OpenImageIO::OpenImageIO ALIAS PkgConfig::openimageio)
endif()
