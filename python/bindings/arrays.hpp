#pragma once

#include "scene/error.hpp"
#include "scene/image.hpp"
#include "scene/vec.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <vector>

/// Converts between numpy arrays and the library's memory.
namespace gnomon::python {

namespace py = pybind11;

/// A read-only array over memory of `owner`, which it keeps alive.
/// @param strides  [bytes]; empty for packed C order.
template <typename Number>
py::array view_of(const Number* data, std::vector<py::ssize_t> shape, py::handle owner,
                  std::vector<py::ssize_t> strides = {})
{
    py::array array{py::dtype::of<Number>(), std::move(shape), std::move(strides), data, owner};
    py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
    return array;
}

template <typename Number>
py::array view_of(const std::vector<Number>& numbers, py::handle owner)
{
    return view_of(numbers.data(), {static_cast<py::ssize_t>(numbers.size())}, owner);
}

/// A height × width array over an image; empty for an empty image.
template <typename Number, typename Pixel>
py::object view_of(const scene::Image<Pixel>& image, const Number* first, py::handle owner,
                   py::ssize_t channels = 1)
{
    if (image.empty()) {
        return py::none();
    }
    const py::ssize_t width = image.size().width_px;
    std::vector<py::ssize_t> shape{image.size().height_px, width};
    std::vector<py::ssize_t> strides{width * py::ssize_t{sizeof(Pixel)}, sizeof(Pixel)};
    if (channels > 1) {
        shape.push_back(channels);
        strides.push_back(sizeof(Number));
    }
    return view_of(first, shape, owner, strides);
}

/// Converts an argument to a C-ordered array of this type.
/// @throws scene::InputError  naming the argument.
template <typename Number>
py::array_t<Number> numbers_of(const py::object& given, const std::string& argument)
{
    auto array = py::array_t<Number, py::array::c_style | py::array::forcecast>::ensure(given);
    if (!array) {
        if (PyErr_ExceptionMatches(PyExc_MemoryError) != 0) {
            throw py::error_already_set();
        }
        PyErr_Clear();
        throw scene::InputError(argument + " must be an array of numbers");
    }
    return array;
}

/// An n × columns array as points.
template <typename Vector, std::size_t columns>
std::vector<Vector> vectors_of(const py::object& given, const std::string& argument)
{
    const auto array = numbers_of<typename Vector::value_type>(given, argument);
    if (array.size() == 0) {
        return {};
    }
    if (array.ndim() != 2 || array.shape(1) != py::ssize_t{columns}) {
        std::string shape;
        for (py::ssize_t axis = 0; axis < array.ndim(); ++axis) {
            shape += (axis > 0 ? ", " : "") + std::to_string(array.shape(axis));
        }
        throw scene::InputError(argument + " has the shape (" + shape + "): it must be (n, " +
                                std::to_string(columns) + ")");
    }
    std::vector<Vector> vectors(static_cast<std::size_t>(array.shape(0)));
    static_assert(sizeof(Vector) == columns * sizeof(typename Vector::value_type));
    if (!vectors.empty()) {
        std::memcpy(static_cast<void*>(vectors.data()), array.data(),
                    vectors.size() * sizeof(Vector));
    }
    return vectors;
}

/// A height × width (× channels) array as an image.
template <typename Pixel, std::size_t channels = 1>
scene::Image<Pixel> image_of(const py::object& given, const std::string& argument)
{
    constexpr py::ssize_t most_px = 1 << 15;
    if (given.is_none()) {
        return {};
    }
    const auto array = numbers_of<float>(given, argument);
    const bool has_shape = channels == 1
                               ? array.ndim() == 2
                               : array.ndim() == 3 && array.shape(2) == py::ssize_t{channels};
    if (!has_shape || array.shape(0) < 1 || array.shape(1) < 1 || array.shape(0) > most_px ||
        array.shape(1) > most_px) {
        throw scene::InputError(argument +
                                (channels == 1 ? " must have the shape (height, width)"
                                               : " must have the shape (height, width, 3)") +
                                ", with 1 to 32768 pixels each way");
    }
    scene::Image<Pixel> image{{static_cast<int>(array.shape(1)), static_cast<int>(array.shape(0))}};
    static_assert(sizeof(Pixel) == channels * sizeof(float));
    std::memcpy(static_cast<void*>(image.data()), array.data(),
                image.pixel_count() * sizeof(Pixel));
    return image;
}

} // namespace gnomon::python
