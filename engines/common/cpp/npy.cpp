#include "cpp/npy.hpp"

#include <bit>
#include <fstream>
#include <stdexcept>
#include <string>

namespace engine {

void write_npy(const std::filesystem::path& file, const std::vector<float>& values, int width,
               int height, int count)
{
    static_assert(std::endian::native == std::endian::little);
    const std::string per_pixel = count == 1 ? "" : ", " + std::to_string(count);
    std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" +
                         std::to_string(height) + ", " + std::to_string(width) + per_pixel + "), }";
    constexpr std::size_t begin = 10; // of the header, after magic number, version and length
    header.append((64 - (begin + header.size() + 1) % 64) % 64, ' ');
    header += '\n';
    std::ofstream stream{file, std::ios::binary};
    stream.write("\x93NUMPY\x01\x00", 8);
    const auto size = static_cast<unsigned>(header.size());
    stream.put(static_cast<char>(size % 256)).put(static_cast<char>(size / 256));
    stream << header;
    stream.write(reinterpret_cast<const char*>(values.data()),
                 static_cast<std::streamsize>(values.size() * sizeof(float)));
    if (!stream.flush()) {
        throw std::runtime_error{file.string() + " cannot be written"};
    }
}

} // namespace engine
