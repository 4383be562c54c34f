// For programs that link OpenImageIO.
#include "store/images/image_codec.hpp"

namespace gnomon::store {

const ImageCodec& image_codec()
{
    return openimageio_codec();
}

} // namespace gnomon::store
