// SPDX-License-Identifier: BSD-3-Clause
// Scene files of any content: an error and the scene as it was, or a scene that comes back from its
// own text.
#include "FuzzInput.h"
#include "FuzzMessages.h"

#include "vtkLightCollection.h"
#include "vtkNew.h"
#include "vtkReliefScene.h"
#include "vtkReliefSceneFile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  FuzzMessages messages;
  vtkNew<vtkReliefSceneFile> file;
  file->GetScene()->SetHeightScale(3.0);
  const bool read = file->FromText(std::string(reinterpret_cast<const char*>(data), size));
  FUZZ_CHECK(read == (file->GetErrorCode() == 0));
  FUZZ_CHECK(messages.Count() == (read ? 0 : 1));
  if (!read)
  {
    FUZZ_CHECK(file->GetScene()->GetHeightScale() == 3.0);
    FUZZ_CHECK(file->GetScene()->GetLights()->GetNumberOfItems() == 0);
    return 0;
  }
  const std::string text = file->ToText();
  FUZZ_CHECK(!text.empty() && messages.Count() == 0);
  vtkNew<vtkReliefSceneFile> again;
  FUZZ_CHECK(again->FromText(text) && messages.Count() == 0);
  FUZZ_CHECK(again->ToText() == text);
  return 0;
}
