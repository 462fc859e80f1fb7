// SPDX-License-Identifier: BSD-3-Clause
// What happens when memory runs out: this program's allocator fails when it is told to. Wherever it
// does within an update, the filter, the readers and the writers report one error, leave nothing
// half done, and do next time what they would have done.
#include "vtkImageReliefShading.h"
#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkOpenEXRLayerWriter.h"
#include "vtkOpenImageIOReader.h"
#include "vtkOpenImageIOWriter.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkSMPTools.h"
#include "vtkShortArray.h"
#include "vtkUnsignedCharArray.h"

#include "ImageFileTestUtilities.h"

#include <atomic>
#include <cstdlib>
#include <new>

#if defined(__unix__)
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace
{
int Failures = 0;

// Which allocations fail: of those of at least this size the n-th, or all if that is 0.
struct Plan
{
  std::size_t Size = 0;
  long Which = 0;
};
Plan Given;
std::atomic<bool> Armed{ false };
std::atomic<long> Count{ 0 };
std::atomic<long> Failed{ 0 };

bool Fails(std::size_t size)
{
  if (!Armed || size < Given.Size || (++Count != Given.Which && Given.Which != 0))
  {
    return false;
  }
  ++Failed;
  return true;
}

void Arm(const Plan& plan)
{
  Given = plan;
  Failed = 0;
  Count = 0;
  Armed = plan.Size > 0;
}
}

// VTK allocates arrays by malloc, which operator new calls as well. A sanitizer has its own, and
// what is left then is operator new.
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
extern "C"
{
  void* __libc_malloc(std::size_t size);
  void* __libc_calloc(std::size_t count, std::size_t size);
  void* __libc_realloc(void* old, std::size_t size);

  void* malloc(std::size_t size)
  {
    return Fails(size) ? nullptr : __libc_malloc(size);
  }
  void* calloc(std::size_t count, std::size_t size)
  {
    return Fails(count * size) ? nullptr : __libc_calloc(count, size);
  }
  void* realloc(void* old, std::size_t size)
  {
    return Fails(size) ? nullptr : __libc_realloc(old, size);
  }
}
#else
void* operator new(std::size_t size)
{
  void* memory = Fails(size) ? nullptr : std::malloc(size);
  return memory ? memory : throw std::bad_alloc();
}
void operator delete(void* memory) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}
#endif

namespace
{
// Fails while the filter works, and not in VTK's own pipeline around it.
class vtkFaultyShading : public vtkImageReliefShading
{
public:
  static vtkFaultyShading* New();
  vtkTypeMacro(vtkFaultyShading, vtkImageReliefShading);

  Plan Failures;

protected:
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override
  {
    Arm(this->Failures);
    const int result = this->Superclass::RequestData(request, inputs, outputs);
    Armed = false;
    return result;
  }
};
vtkStandardNewMacro(vtkFaultyShading);

// A filter, what makes it start from nothing, and what it is to give.
struct Case
{
  const char* Name;
  vtkNew<vtkFaultyShading> Filter;
  vtkNew<vtkReliefScene> Scene;
  vtkSmartPointer<vtkImageData> Expected;

  explicit Case(const char* name)
    : Name(name)
  {
    this->Filter->SetScene(this->Scene);
  }

  void Expect()
  {
    this->Filter->Update();
    this->Expected = vtkSmartPointer<vtkImageData>::New();
    this->Expected->DeepCopy(this->Filter->GetOutput());
    CHECK(this->Expected->GetNumberOfPoints() > 0);
  }

  bool IsExpected()
  {
    vtkPointData* given = this->Filter->GetOutput()->GetPointData();
    vtkPointData* expected = this->Expected->GetPointData();
    bool same = given->GetNumberOfArrays() == expected->GetNumberOfArrays();
    for (int a = 0; same && a < expected->GetNumberOfArrays(); ++a)
    {
      same = SameBytes(given->GetArray(a), expected->GetArray(a));
    }
    return same;
  }

  // An update from nothing during which memory fails, and one during which it does not. Returns
  // whether any allocation failed.
  bool Fail(const Plan& plan)
  {
    MessageKeeper messages(this->Filter);
    this->Filter->ReleaseCache();
    this->Filter->Modified();
    this->Filter->Failures = plan;
    this->Filter->Update();
    const bool failed = Failed > 0;
    // What a message or a warning fails to allocate, it does without.
    if (messages.Silent())
    {
      CHECK(this->IsExpected());
    }
    else
    {
      CHECK(failed);
      CHECK(messages.OneError("enough memory"));
      CHECK(this->Filter->GetOutput()->GetNumberOfPoints() == 0);
      CHECK(this->Filter->GetOutput()->GetPointData()->GetNumberOfArrays() == 0);
    }
    this->Filter->Failures = Plan();
    this->Filter->Modified();
    this->Filter->Update();
    CHECK(messages.Silent());
    CHECK(this->IsExpected());
    return failed;
  }
};

void Sun(Case& c)
{
  c.Filter->SetInputData(MakeHeights(170, 40, Hills(1)));
  c.Scene->AddSun(300.0, 30.0, 2.0);
  c.Scene->SetNumberOfSunSamples(3);
}

// Everything at once: a copy of the heights, a mask, textures, a colour table, a lamp, an
// environment, all layers.
void All(Case& c)
{
  c.Filter->SetInputData(MakeHeights<vtkShortArray>(166, 37, Hills(2)));
  c.Filter->SetMaskData(
    MakeHeights<vtkUnsignedCharArray>(166, 37, [](int i, int j) { return (i * j) % 11; }));
  c.Filter->SetDiffuseTextureData(MakeHeights<vtkUnsignedCharArray>(5, 4, Hills(3)));
  c.Filter->StretchTexturesOn();
  vtkNew<vtkLookupTable> table;
  table->SetRange(0.0, 60.0);
  c.Filter->SetLookupTable(table);
  c.Filter->GenerateIlluminationOn();
  c.Filter->GenerateThicknessOn();
  c.Filter->GenerateNormalsOn();
  c.Filter->GenerateBaseOn();
  c.Filter->GenerateDiffuseOn();
  c.Filter->GenerateScatterOn();
  c.Filter->GenerateSpecularOn();
  c.Filter->SetNoDataValue(30.0);
  c.Scene->AddSun(100.0, 40.0);
  vtkNew<vtkLight> lamp;
  lamp->SetLightTypeToSceneLight();
  lamp->PositionalOn();
  lamp->SetPosition(20.0, 10.0, 80.0);
  c.Scene->AddLight(lamp);
  vtkNew<vtkReliefEnvironment> environment;
  environment->SetImageToClearSky(90.0, 30.0, 3.0);
  environment->SetSamplingToImportance();
  environment->SetNumberOfSamples(6);
  c.Scene->SetEnvironment(environment);
  c.Scene->GetMaterial()->SetSpecularCoefficient(0.3);
  c.Scene->GetMaterial()->SetForwardScatterCoefficient(0.3);
  c.Scene->GetMaterial()->SetOffsetModeToSurfaceNormal();
}

void Steps(Case& c)
{
  c.Filter->SetInputData(MakeHeights(130, 20, Hills(4)));
  c.Filter->SetOutputScalarType(VTK_UNSIGNED_CHAR);
  c.Scene->AddSun(300.0, 30.0);
  c.Scene->SetIntegratorToFixedStep();
  c.Scene->SetNumberOfSteps(16);
}

// Each allocation of an update fails once, but for small ones: VTK's own objects do not survive it.
void TestEachAllocation()
{
  vtkSMPTools::SetBackend("Sequential");
  for (auto make : { Sun, All, Steps })
  {
    Case c(make == Sun ? "sun" : make == All ? "all" : "steps");
    make(c);
    c.Expect();
    long count = 0;
    const int failures = Failures;
    while (Failures == failures && c.Fail({ 600, count + 1 }))
    {
      ++count;
    }
    std::cout << c.Name << ": " << count << " allocations" << std::endl;
    // Fixed steps read heights where they are and need no bounds of them: the picture's room and
    // what a run keeps are all that is allocated.
    CHECK(count > (make == Steps ? 3 : 4));
  }
}

// On several threads every allocation above a size fails, in whichever thread it comes.
void TestThreads()
{
  vtkSMPTools::SetBackend("STDThread");
  vtkSMPTools::Initialize(4);
  for (auto make : { Sun, All })
  {
    Case c(make == Sun ? "sun" : "all");
    make(c);
    c.Expect();
    int failed = 0;
    for (std::size_t size = std::size_t(1) << 20; size >= 600; size /= 2)
    {
      failed += c.Fail({ size, 0 }) ? 1 : 0;
    }
    std::cout << c.Name << ", threads: " << failed << " limits" << std::endl;
    CHECK(failed > 5);
  }
}

// Nothing that is this large can be allocated while an algorithm is updated.
template <class Update>
void UpdateWithin(std::size_t size, Update&& update)
{
  Arm({ size, 0 });
  update();
  Armed = false;
}

void TestFiles(const std::string& directory)
{
  const vtkSmartPointer<vtkImageData> heights = MakeHeights(300, 300, Hills(5));
  for (const char* extension : { "exr", "tif", "hdr" })
  {
    const std::string name = directory + "heights." + extension;
    WriteText(name, "before");
    vtkNew<vtkOpenImageIOWriter> writer;
    MessageKeeper messages(writer);
    vtkSmartPointer<vtkImageData> image = heights;
    if (std::string(extension) == "hdr")
    {
      image = vtkSmartPointer<vtkImageData>::New();
      image->SetDimensions(300, 300, 1);
      image->AllocateScalars(VTK_FLOAT, 3);
      image->GetPointData()->GetScalars()->Fill(0.5);
    }
    writer->SetInputData(image);
    writer->SetFileName(name.c_str());
    const int files = CountFiles(directory);
    UpdateWithin(65536, [&]() { writer->Write(); });
    CHECK(writer->GetErrorCode() != 0);
    CHECK(messages.OneError("enough memory"));
    CHECK(FileText(name) == "before" && CountFiles(directory) == files);
    writer->Write();
    CHECK(writer->GetErrorCode() == 0 && messages.Silent());
    CHECK(CountFiles(directory) == files);

    vtkNew<vtkOpenImageIOReader> reader;
    MessageKeeper readerMessages(reader);
    reader->SetFileName(name.c_str());
    reader->UpdateInformation();
    UpdateWithin(65536, [&]() { reader->Update(); });
    CHECK(reader->GetErrorCode() != 0);
    CHECK(readerMessages.OneError("enough memory"));
    CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
    CHECK(reader->GetMaskOutput()->GetNumberOfPoints() == 0);
    reader->Modified();
    reader->Update();
    CHECK(reader->GetErrorCode() == 0 && readerMessages.Silent());
    CHECK(reader->GetOutput()->GetNumberOfPoints() == 90000);
  }

  const std::string name = directory + "layers.exr";
  WriteText(name, "before");
  vtkNew<vtkOpenEXRLayerWriter> writer;
  MessageKeeper messages(writer);
  writer->SetInputData(heights);
  writer->SetFileName(name.c_str());
  const int files = CountFiles(directory);
  UpdateWithin(65536, [&]() { writer->Write(); });
  CHECK(writer->GetErrorCode() != 0);
  CHECK(messages.OneError("enough memory"));
  CHECK(FileText(name) == "before" && CountFiles(directory) == files);
  writer->Write();
  CHECK(writer->GetErrorCode() == 0 && messages.Silent() && CountFiles(directory) == files);
}
}

// A VTK that was built without NDEBUG ends the program where an array cannot be allocated, whatever
// its user would do then. Tried in a process of its own.
bool VTKAborts()
{
#if defined(__unix__)
  const pid_t child = fork();
  if (child == 0)
  {
    Arm({ 600, 0 });
    try
    {
      vtkNew<vtkShortArray> array;
      array->SetNumberOfValues(1000);
    }
    catch (const std::bad_alloc&)
    {
    }
    _exit(0);
  }
  int status = 0;
  return child > 0 && waitpid(child, &status, 0) == child && WIFSIGNALED(status);
#else
  return false;
#endif
}

int main(int argc, char* argv[])
{
  if (VTKAborts())
  {
    std::cout << "skipped: this VTK aborts where memory runs out" << std::endl;
    return 77;
  }
  TestEachAllocation();
  TestThreads();
  TestFiles(EmptyDirectory(argc, argv, "TestFaultsMemory"));
  return Failures > 0 ? 1 : 0;
}
