#include "reports/images/codec_module.hpp"

extern "C" __attribute__((visibility("default"))) const gnomon::reports::ImageCodec*
gnomon_image_codec()
{
    return &gnomon::reports::openimageio_codec();
}
