; BambuStudio 01.09.05.51
; EXECUTABLE_BLOCK_START
M83
; FEATURE: Outer wall
; LAYER_HEIGHT: 0.2
; start printing object, unique label id: 97
T1000
G1 X5 E1
; FLUSH_START
G1 E5
; FLUSH_END
G3 Z.6 I1.2 J0 P1 F60000
; stop printing object, unique label id: 97
; EXECUTABLE_BLOCK_END
