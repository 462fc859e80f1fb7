// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFileAccess.h"

#include "vtkType.h"

#include <type_traits>

namespace relief::io
{
using OIIO::TypeDesc;

//------------------------------------------------------------------------------
int VTKType(OIIO::TypeDesc type)
{
  switch (type.basetype)
  {
    case TypeDesc::UINT8:
      return VTK_UNSIGNED_CHAR;
    case TypeDesc::INT8:
      return VTK_SIGNED_CHAR;
    case TypeDesc::UINT16:
      return VTK_UNSIGNED_SHORT;
    case TypeDesc::INT16:
      return VTK_SHORT;
    case TypeDesc::UINT32:
      return VTK_UNSIGNED_INT;
    case TypeDesc::INT32:
      return VTK_INT;
    case TypeDesc::UINT64:
      return VTK_UNSIGNED_LONG_LONG;
    case TypeDesc::INT64:
      return VTK_LONG_LONG;
    case TypeDesc::HALF:
    case TypeDesc::FLOAT:
      return VTK_FLOAT;
    case TypeDesc::DOUBLE:
      return VTK_DOUBLE;
    default:
      return VTK_VOID;
  }
}

//------------------------------------------------------------------------------
OIIO::TypeDesc FileType(int vtkType)
{
  switch (vtkType)
  {
    case VTK_CHAR:
      return std::is_signed<char>::value ? TypeDesc::INT8 : TypeDesc::UINT8;
    case VTK_SIGNED_CHAR:
      return TypeDesc::INT8;
    case VTK_UNSIGNED_CHAR:
      return TypeDesc::UINT8;
    case VTK_SHORT:
      return TypeDesc::INT16;
    case VTK_UNSIGNED_SHORT:
      return TypeDesc::UINT16;
    case VTK_INT:
      return TypeDesc::INT32;
    case VTK_UNSIGNED_INT:
      return TypeDesc::UINT32;
    case VTK_LONG:
      return sizeof(long) == 8 ? TypeDesc::INT64 : TypeDesc::INT32;
    case VTK_UNSIGNED_LONG:
      return sizeof(long) == 8 ? TypeDesc::UINT64 : TypeDesc::UINT32;
    case VTK_LONG_LONG:
      return TypeDesc::INT64;
    case VTK_UNSIGNED_LONG_LONG:
      return TypeDesc::UINT64;
    case VTK_ID_TYPE:
      return sizeof(vtkIdType) == 8 ? TypeDesc::INT64 : TypeDesc::INT32;
    case VTK_FLOAT:
      return TypeDesc::FLOAT;
    case VTK_DOUBLE:
      return TypeDesc::DOUBLE;
    default:
      return TypeDesc::UNKNOWN;
  }
}
}
