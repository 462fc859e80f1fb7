//VTK::TCoord::Impl

  // Interpolated beside samples without data, colour and alpha fall off together.
  gl_FragData[0].rgb = exposure * tcolor.rgb / max(tcolor.a, 1.0e-6);
  //RELIEF::If Encoded
  gl_FragData[0].rgb = vec3(reliefEncode(gl_FragData[0].r), reliefEncode(gl_FragData[0].g),
    reliefEncode(gl_FragData[0].b));
  //RELIEF::End
