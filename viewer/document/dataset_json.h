#ifndef document_dataset_json_h
#define document_dataset_json_h

#include "document/work.h"

#include <nlohmann/json.hpp>

#include <stdexcept>
#include <string>

// Converts the parts of a session to and from JSON. Input is checked. Numbers are written with all
// digits, so that they are read back bit for bit.

/// Thrown if a JSON text is invalid. The message is a clause without a capital letter or period,
/// for example "the pose has 3 entries for 2 handles".
class SessionError : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};

/// Return the value of a key. Throw SessionError if `object` is not an object or lacks the key.
const nlohmann::json& json_at(const nlohmann::json& object, const char* key);
double json_number(const nlohmann::json& value, const char* value_name);
int json_integer(const nlohmann::json& value, const char* value_name, int lowest, int highest);
std::string json_text(const nlohmann::json& value, const char* value_name);

/// Convert points, vertices, lines and polygons with their cell arrays.
nlohmann::json handles_to_json(vtkPolyData* handles);
vtkSmartPointer<vtkPolyData> handles_from_json(const nlohmann::json& json);

nlohmann::json pose_to_json(const bindpose::HandlePose& pose);
bindpose::HandlePose pose_from_json(const nlohmann::json& json);

nlohmann::json stored_poses_to_json(const bindpose::StoredPoses& poses);
bindpose::StoredPoses stored_poses_from_json(const nlohmann::json& json);

nlohmann::json options_to_json(const Options& options);
/// Read options. A missing option gets its initial value; unknown options are ignored.
Options options_from_json(const nlohmann::json& json);

#endif
