// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightTypes_h
#define HeightTypes_h

/// @file
/// The types of number that heights come in: what is made for a HeightSource is made for each.

#define RELIEF_FOR_HEIGHT_TYPES(make)                                                              \
  make(char);                                                                                      \
  make(signed char);                                                                               \
  make(unsigned char);                                                                             \
  make(short);                                                                                     \
  make(unsigned short);                                                                            \
  make(int);                                                                                       \
  make(unsigned int);                                                                              \
  make(long);                                                                                      \
  make(unsigned long);                                                                             \
  make(long long);                                                                                 \
  make(unsigned long long);                                                                        \
  make(float);                                                                                     \
  make(double)

#endif
