// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What Python itself cannot do with VTK's classes, for the package alone: an update during which
/// other Python threads run (a wrapped Update() holds the interpreter's lock all the time), and
/// other methods for classes that do not let them be replaced.

#include "vtkPython.h" // Before any other.

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkPythonUtil.h"
#include "vtkSmartPointer.h"
#include "vtkVersionMacros.h"

#include <chrono>
#include <exception>
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
PyObject* Update(PyObject*, PyObject* argument)
{
  auto* algorithm =
    static_cast<vtkAlgorithm*>(vtkPythonUtil::GetPointerFromObject(argument, "vtkAlgorithm"));
  if (!algorithm)
  {
    if (!PyErr_Occurred())
    {
      PyErr_SetString(PyExc_TypeError, "a vtkAlgorithm is expected");
    }
    return nullptr;
  }
  const vtkSmartPointer<vtkAlgorithm> kept = algorithm;
  vtkNew<SignalCommand> signals;
  const unsigned long tag = algorithm->AddObserver(vtkCommand::ProgressEvent, signals);
  std::string wrong;
  bool full = false;
  Py_BEGIN_ALLOW_THREADS;
  try
  {
    algorithm->Update();
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
  algorithm->RemoveObserver(tag);
  if (signals->Raised)
  {
    algorithm->SetAbortExecute(0);
    algorithm->Modified(); // its output is empty and must not count as up to date
    PyErr_Restore(signals->Type, signals->Value, signals->Traceback);
    return nullptr;
  }
  if (full)
  {
    return PyErr_NoMemory();
  }
  if (!wrong.empty())
  {
    PyErr_SetString(PyExc_RuntimeError, wrong.c_str());
    return nullptr;
  }
  Py_RETURN_NONE;
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
  { "set_method", SetMethod, METH_VARARGS,
    "set_method(type, name, method)\n\nReplaces a method of a class itself; None takes it away." },
  { nullptr, nullptr, 0, nullptr },
};

PyModuleDef Definition = { PyModuleDef_HEAD_INIT, "_pipeline",
  "Updates without the interpreter's lock. Private to the package.", -1, Methods, nullptr, nullptr,
  nullptr, nullptr };

}

// Python asks for this name. NOLINTNEXTLINE(bugprone-reserved-identifier)
PyMODINIT_FUNC PyInit__pipeline()
{
  return PyModule_Create(&Definition);
}
