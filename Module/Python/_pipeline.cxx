// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What Python itself cannot do with VTK's classes, for the package alone: updates, files and
/// height scales during which other Python threads run (a wrapped method holds the interpreter's
/// lock all the time), and other methods for classes that do not let them be replaced.

#include "vtkPython.h" // Before any other.

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkImageData.h"
#include "vtkImageWriter.h" // its Write() is virtual: the library is the writer's affair
#include "vtkNew.h"
#include "vtkPythonUtil.h"
#include "vtkReliefScene.h"
#include "vtkSmartPointer.h"
#include "vtkVersionMacros.h"

#include <chrono>
#include <exception>
#include <limits>
#include <new>
#include <string>

namespace
{

//------------------------------------------------------------------------------
/// Lets Python's signals (Ctrl+C) end an update: looks for them when there is progress, but not so
/// often that waiting for other threads would count.
class SignalCommand : public vtkCommand
{
public:
  static SignalCommand* New() { return new SignalCommand; }

  void Execute(vtkObject* caller, unsigned long, void*) override
  {
    const auto now = std::chrono::steady_clock::now();
    if (this->Raised || now - this->Last < std::chrono::milliseconds(50))
    {
      return;
    }
    this->Last = now;
    const PyGILState_STATE state = PyGILState_Ensure();
    if (PyErr_CheckSignals() != 0)
    {
      // Kept until the update has ended and its thread has the lock again.
      PyErr_Fetch(&this->Type, &this->Value, &this->Traceback);
      this->Raised = true;
      static_cast<vtkAlgorithm*>(caller)->SetAbortExecute(1);
    }
    PyGILState_Release(state);
  }

  bool Raised = false;
  PyObject* Type = nullptr;
  PyObject* Value = nullptr;
  PyObject* Traceback = nullptr;

private:
  std::chrono::steady_clock::time_point Last = std::chrono::steady_clock::now();
};

//------------------------------------------------------------------------------
/// The object of VTK that an argument is, or null and Python's exception.
template <typename T>
T* ObjectOf(PyObject* argument, const char* type)
{
  auto* object = static_cast<T*>(vtkPythonUtil::GetPointerFromObject(argument, type));
  if (!object && !PyErr_Occurred())
  {
    PyErr_Format(PyExc_TypeError, "a %s is expected", type);
  }
  return object;
}

//------------------------------------------------------------------------------
/// Works while other threads run. Returns false with Python's exception for what is thrown.
template <typename Work>
bool RunUnlocked(Work work)
{
  std::string wrong;
  bool full = false;
  Py_BEGIN_ALLOW_THREADS;
  try
  {
    work();
  }
  catch (const std::bad_alloc&)
  {
    full = true;
  }
  catch (const std::exception& exception)
  {
    wrong = exception.what();
    wrong = wrong.empty() ? "the update failed" : wrong;
  }
  Py_END_ALLOW_THREADS;
  if (full)
  {
    PyErr_NoMemory();
  }
  else if (!wrong.empty())
  {
    PyErr_SetString(PyExc_RuntimeError, wrong.c_str());
  }
  return !full && wrong.empty();
}

//------------------------------------------------------------------------------
/// The same with an algorithm, which signals end.
template <typename Work>
PyObject* RunAlgorithm(vtkAlgorithm* algorithm, Work work)
{
  const vtkSmartPointer<vtkAlgorithm> kept = algorithm;
  vtkNew<SignalCommand> signals;
  const unsigned long tag = algorithm->AddObserver(vtkCommand::ProgressEvent, signals);
  const bool done = RunUnlocked(work);
  algorithm->RemoveObserver(tag);
  if (signals->Raised)
  {
    algorithm->SetAbortExecute(0);
    algorithm->Modified(); // its output is empty and must not count as up to date
    PyErr_Restore(signals->Type, signals->Value, signals->Traceback);
    return nullptr;
  }
  if (!done)
  {
    return nullptr;
  }
  Py_RETURN_NONE;
}

//------------------------------------------------------------------------------
PyObject* Update(PyObject*, PyObject* argument)
{
  auto* algorithm = ObjectOf<vtkAlgorithm>(argument, "vtkAlgorithm");
  return algorithm ? RunAlgorithm(algorithm, [&]() { algorithm->Update(); }) : nullptr;
}

//------------------------------------------------------------------------------
PyObject* Write(PyObject*, PyObject* argument)
{
  auto* writer = ObjectOf<vtkImageWriter>(argument, "vtkImageWriter");
  return writer ? RunAlgorithm(writer, [&]() { writer->Write(); }) : nullptr;
}

//------------------------------------------------------------------------------
PyObject* FitHeightScale(PyObject*, PyObject* arguments)
{
  PyObject* objects[3] = { nullptr, nullptr, Py_None };
  double noData = std::numeric_limits<double>::quiet_NaN();
  if (!PyArg_ParseTuple(arguments, "OO|Od", &objects[0], &objects[1], &objects[2], &noData))
  {
    return nullptr;
  }
  const vtkSmartPointer<vtkReliefScene> scene =
    ObjectOf<vtkReliefScene>(objects[0], "vtkReliefScene");
  const vtkSmartPointer<vtkImageData> heights =
    scene ? ObjectOf<vtkImageData>(objects[1], "vtkImageData") : nullptr;
  const bool masked = objects[2] != Py_None;
  const vtkSmartPointer<vtkImageData> mask =
    heights && masked ? ObjectOf<vtkImageData>(objects[2], "vtkImageData") : nullptr;
  double scale = 0.0;
  if (!heights || (masked && !mask) ||
    !RunUnlocked([&]() { scale = scene->FitHeightScale(heights, mask, noData); }))
  {
    return nullptr;
  }
  return PyFloat_FromDouble(scale);
}

//------------------------------------------------------------------------------
PyObject* SetMethod(PyObject*, PyObject* arguments)
{
  PyObject* type = nullptr;
  PyObject* name = nullptr;
  PyObject* method = nullptr;
  if (!PyArg_ParseTuple(arguments, "O!UO", &PyType_Type, &type, &name, &method))
  {
    return nullptr;
  }
  // Python refuses it for types that are not its own; VTK fills this dictionary in the same way.
  PyObject* dictionary = reinterpret_cast<PyTypeObject*>(type)->tp_dict;
  const int failed =
    method == Py_None ? PyDict_DelItem(dictionary, name) : PyDict_SetItem(dictionary, name, method);
  if (failed)
  {
    return nullptr;
  }
  PyType_Modified(reinterpret_cast<PyTypeObject*>(type));
  Py_RETURN_NONE;
}

PyMethodDef Methods[] = {
  { "update", Update, METH_O,
    "update(algorithm)\n\nUpdate() of a vtkAlgorithm, during which other threads run." },
  { "write", Write, METH_O,
    "write(writer)\n\nWrite() of a vtkImageWriter, during which other threads run." },
  { "fit_height_scale", FitHeightScale, METH_VARARGS,
    "fit_height_scale(scene, heights, mask=None, nodata=nan)\n\nFitHeightScale() of a "
    "vtkReliefScene, during which other threads run." },
  { "set_method", SetMethod, METH_VARARGS,
    "set_method(type, name, method)\n\nReplaces a method of a class itself; None takes it away." },
  { nullptr, nullptr, 0, nullptr },
};

PyModuleDef Definition = { PyModuleDef_HEAD_INIT, "_pipeline",
  "Work without the interpreter's lock. Private to the package.", -1, Methods, nullptr, nullptr,
  nullptr, nullptr };

}

// Python asks for this name. NOLINTNEXTLINE(bugprone-reserved-identifier)
PyMODINIT_FUNC PyInit__pipeline()
{
  return PyModule_Create(&Definition);
}
