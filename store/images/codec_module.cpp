#include "store/images/codec_module.hpp"

extern "C" __attribute__((visibility("default"))) const gnomon::store::ImageCodec*
gnomon_image_codec()
{
    return &gnomon::store::openimageio_codec();
}
