#ifndef bindpose_tests_fuzz_filter_targets_h
#define bindpose_tests_fuzz_filter_targets_h

#include "fuzz/fuzz_target.h"

namespace bindpose::test
{

/// Return the targets that use VTK:
/// - record: the record in which the helper bindpose-reader returns a dataset;
/// - xml_names: the lines are the names of an array and of its components in an XML file.
const std::vector<FuzzTarget>& filter_fuzz_targets();

} // namespace bindpose::test

#endif
