// For programs that link OpenImageIO.
#include "reports/images/image_codec.hpp"

namespace gnomon::reports {

const ImageCodec& image_codec()
{
    return openimageio_codec();
}

} // namespace gnomon::reports
