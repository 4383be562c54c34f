#pragma once

#include "store/images/image_codec.hpp"

/// The one symbol of the module gnomon_images-VERSION.so, which holds OpenImageIO for programs that
/// load it on demand.
extern "C" const gnomon::store::ImageCodec* gnomon_image_codec();
