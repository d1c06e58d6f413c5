#pragma once
#include <hdf5.h>

#include <carom/gas.hpp>

namespace carom::hdf5 {

/// Numbers with their errors, and groups of curves and fields.
void write_gas(hid_t parent, const GasMeter& meter);

}  // namespace carom::hdf5
