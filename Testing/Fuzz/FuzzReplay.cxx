// SPDX-License-Identifier: BSD-3-Clause
// Gives every file of the folders named on the command line to a fuzzer's target, once: what it has
// found before is tested with any compiler.
#include "FuzzInput.h"

#include <algorithm>
#include <iostream>
#include <iterator>
#include <vector>

extern "C" __attribute__((weak)) int LLVMFuzzerInitialize(int* argc, char*** argv);

int main(int argc, char* argv[])
{
  if (LLVMFuzzerInitialize)
  {
    LLVMFuzzerInitialize(&argc, &argv);
  }
  std::vector<std::filesystem::path> inputs;
  for (int i = 1; i < argc; ++i)
  {
    for (const auto& entry : std::filesystem::directory_iterator(argv[i]))
    {
      inputs.push_back(entry.path());
    }
  }
  std::sort(inputs.begin(), inputs.end());
  for (const std::filesystem::path& path : inputs)
  {
    std::cout << path.string() << std::endl;
    std::ifstream stream(path, std::ios::binary);
    const std::vector<char> bytes{ std::istreambuf_iterator<char>(stream), {} };
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  }
  std::cout << inputs.size() << " inputs" << std::endl;
  return inputs.empty() ? 1 : 0;
}
