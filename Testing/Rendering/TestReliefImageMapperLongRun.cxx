// SPDX-License-Identifier: BSD-3-Clause
//
// Frames of the mapper with changing scenes, and a light dragged about, leave neither memory nor
// objects of OpenGL behind. RELIEF_SEED repeats a run, RELIEF_UPDATES makes it longer;
// GLIBC_TUNABLES as in TestReliefLongRun.

#include "ReliefMapperPlayer.h"
#include "ReliefWidgetTestUtilities.h"

#include <algorithm>
#include <set>

namespace
{

int Failures = 0;

// How many objects a context holds, by kind. OpenGL gives them small numbers, the same ones again.
struct ContextObjects
{
  int textures = 0;
  int buffers = 0;
  int framebuffers = 0;
  int renderbuffers = 0;
  int vertexArrays = 0;
  int programs = 0;
  int shaders = 0;

  static ContextObjects Count()
  {
    ContextObjects objects;
    for (GLuint name = 1; name < 20000; ++name)
    {
      objects.textures += glIsTexture(name);
      objects.buffers += glIsBuffer(name);
      objects.framebuffers += glIsFramebuffer(name);
      objects.renderbuffers += glIsRenderbuffer(name);
      objects.vertexArrays += glIsVertexArray(name);
      objects.programs += glIsProgram(name);
      objects.shaders += glIsShader(name);
    }
    return objects;
  }
};

// Other lights, other heights and another part of them from frame to frame, with the same programs:
// of one size, since Mesa compiles them anew for textures with a power of two for a side.
void TestFrames(unsigned int seed, int frames)
{
  MapperPlayer player(seed);
  vtkLight* sun = player.Stage.Scene()->AddSun(0.0, 30.0);
  Footprint footprint;
  for (int frame = 1; frame <= frames; ++frame)
  {
    const bool rest = frame % (frames / 10) == 0;
    sun->SetPosition(rest ? 1.0 : player.Changes.Share(), 1.0, 0.5);
    if (rest || frame % 4 == 0)
    {
      player.Stage.mapper->SetInputData(MakeHeights(60, 40, Hills(rest ? 0 : frame)));
    }
    player.Stage.renderer->GetActiveCamera()->SetParallelScale(10.0 + (rest ? 10 : frame % 30));
    if (rest)
    {
      // A part of the field that is larger than what is seen now may be kept from before.
      player.Stage.mapper->ReleaseGraphicsResources(player.Stage.window);
    }
    CHECK(player.Stage.Render());
    if (rest)
    {
      footprint.Note(frame);
    }
  }
  // Seen: 7 kB, in which Mesa has prepared for what it had not met before.
  CHECK(footprint.Allocated() <= 32768.0);
  CHECK(footprint.Resident() <= 4.0e6);
}

// What VTK and Mesa keep of a context in which only a background was drawn: 2 to 6 kB with Mesa 22,
// 118 kB with Mesa 25.
double BytesPerContext()
{
  vtkNew<vtkRenderWindow> window;
  window->OffScreenRenderingOn();
  window->AddRenderer(vtkNew<vtkRenderer>());
  Footprint footprint;
  for (int context = 1; context <= 20; ++context)
  {
    window->Render();
    window->Finalize();
    if (context % 10 == 0)
    {
      footprint.Note(context);
    }
  }
  return std::max(footprint.Allocated(), 0.0) / 10.0;
}

class LongRun
{
public:
  explicit LongRun(unsigned int seed)
    : Player(seed)
  {
  }

  void Play(int updates)
  {
    const double left = BytesPerContext();
    this->Rest();
    const ContextObjects before = ContextObjects::Count();
    std::set<vtkMTimeType> contexts;
    Footprint footprint;
    for (int update = 1; update <= updates && Failures == 0; ++update)
    {
      if (this->Player.Changes.Below(20) == 0)
      {
        this->Player.Lose();
      }
      this->Player.Change();
      CHECK(this->Player.Stage.Render());
      contexts.insert(this->Player.Stage.window->GetContextCreationTime());
      if (update % (updates / 10) == 0)
      {
        this->Rest();
        this->Compare(ContextObjects::Count(), before);
        // With the context go the programs, of which there are more with every combination of
        // effects that has been shown.
        this->Player.Stage.window->Finalize();
        this->Rest();
        footprint.Note(update);
      }
    }
    CHECK(footprint.Allocated() <= 65536.0 + (1.0e4 + 1.5 * left) * contexts.size());
  }

private:
  // The same state, whatever has been before.
  void Rest()
  {
    vtkOpenGLReliefImageMapper* mapper = this->Player.Stage.mapper;
    mapper->SetScene(vtkNew<vtkReliefScene>());
    mapper->SetInputData(this->Heights);
    for (int port = 1; port < mapper->GetNumberOfInputPorts(); ++port)
    {
      mapper->SetInputDataObject(port, nullptr);
    }
    mapper->SetCacheMemoryLimit(1024);
    CHECK(this->Player.RenderAll());
  }

  void Compare(const ContextObjects& now, const ContextObjects& before) const
  {
    CHECK(now.textures == before.textures);
    CHECK(now.buffers == before.buffers);
    CHECK(now.framebuffers == before.framebuffers);
    CHECK(now.renderbuffers == before.renderbuffers);
    // One for each of the mapper's programs, and one for the rectangle. VTK keeps each program that
    // the window has had.
    CHECK(now.vertexArrays == this->Player.Stage.mapper->GetNumberOfPrograms() + 1);
    CHECK(now.programs >= before.programs && now.shaders == 2 * now.programs);
    std::cout << now.textures << " textures, " << now.buffers << " buffers, " << now.framebuffers
              << " framebuffers, " << now.vertexArrays << " vertex arrays, " << now.programs
              << " programs" << std::endl;
  }

  MapperPlayer Player;
  vtkSmartPointer<vtkImageData> Heights = MakeHeights(60, 40, Hills(1));
};

// A light that is dragged, pushed away and switched between lamp and sun.
void TestEvents(int events)
{
  WidgetStage stage(MakeHeights(30, 20, Hills(1)));
  vtkLight* sun = stage.Scene()->AddSun(0.0, 45.0);
  stage.Widget->On();
  stage.Window->Render();
  ContextObjects before;
  Footprint footprint;
  for (int event = 1; event <= events && Failures == 0; ++event)
  {
    const auto dot = stage.DotInWindow();
    switch (event % 8)
    {
      case 0:
        stage.Event(vtkCommand::MouseWheelForwardEvent, dot[0], dot[1]);
        break;
      case 1:
        stage.Event(vtkCommand::LeftButtonPressEvent, dot[0], dot[1]);
        break;
      case 7:
        stage.Event(vtkCommand::LeftButtonReleaseEvent, dot[0], dot[1]);
        break;
      default:
        stage.Event(vtkCommand::MouseMoveEvent, 10 + event * 7 % 40, 10 + event * 3 % 20);
        break;
    }
    if (event % (events / 10) == 0)
    {
      stage.Event(vtkCommand::LeftButtonReleaseEvent, 0.0, 0.0);
      sun->SetPosition(0.0, 1.0, 1.0);
      stage.Window->Render();
      const ContextObjects now = ContextObjects::Count();
      before = event == events / 10 ? now : before;
      CHECK(now.textures == before.textures && now.buffers == before.buffers &&
        now.framebuffers == before.framebuffers && now.vertexArrays == before.vertexArrays &&
        now.programs == before.programs);
      footprint.Note(event);
    }
  }
  // Seen: 1 kB.
  CHECK(footprint.Allocated() <= 4096.0);
  CHECK(footprint.Resident() <= 2.0e6);
}

}

int TestReliefImageMapperLongRun(int, char*[])
{
  const unsigned int seed = ChooseSeed();
  const int updates = FromEnvironment("RELIEF_UPDATES", 2000);
  TestFrames(seed, updates);
  LongRun(seed).Play(updates / 5);
  TestEvents(5 * updates);
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
