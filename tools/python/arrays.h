#pragma once

#include <memory>
#include <vector>

#include <openvdb/Types.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

namespace vdbcage::python {

/// The type of what a row of an array has.
template <typename Row>
using EntryOf = typename Row::value_type;

/// An array of `rows`, a row each, without a copy. `owner` keeps them alive.
template <typename Row>
pybind11::array arrayOver(const std::vector<Row>& rows, const pybind11::object& owner)
{
    static_assert(sizeof(Row) == Row::size * sizeof(EntryOf<Row>));
    return pybind11::array_t<EntryOf<Row>>({static_cast<pybind11::ssize_t>(rows.size()), pybind11::ssize_t{Row::size}},
                                           reinterpret_cast<const EntryOf<Row>*>(rows.data()), owner);
}

/// The same, which cannot be written to.
template <typename Row>
pybind11::array readOnly(const std::vector<Row>& rows, const pybind11::object& owner)
{
    pybind11::array array = arrayOver(rows, owner);
    array.attr("setflags")(pybind11::arg("write") = false);
    return array;
}

/// An owner of `value`, for arrays over it.
template <typename Value>
pybind11::capsule ownerOf(std::unique_ptr<Value> value)
{
    pybind11::capsule owner(value.get(), [](void* held) { delete static_cast<Value*>(held); });
    value.release();
    return owner;
}

/// An array that owns `rows`.
template <typename Row>
pybind11::array toArray(std::vector<Row> rows)
{
    auto held = std::make_unique<std::vector<Row>>(std::move(rows));
    const std::vector<Row>& kept = *held;
    return arrayOver(kept, ownerOf(std::move(held)));
}

/// The rows of an array of any number type and layout, in one copy.
/// \pre its shape is (n, Row::size), and Row can hold its entries
template <typename Row>
std::vector<Row> toRows(const pybind11::array& array)
{
    std::vector<Row> rows(static_cast<std::size_t>(array.shape(0)));
    pybind11::module_::import("numpy").attr("copyto")(arrayOver(rows, pybind11::capsule(&rows, [](void*) {})), array,
                                                      pybind11::arg("casting") = "unsafe");
    return rows;
}

} // namespace vdbcage::python
