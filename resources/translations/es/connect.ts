<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="es">
<context>
    <name>Connect</name>
    <message>
        <source>Recording</source>
        <translation>Grabación</translation>
    </message>
    <message>
        <source>A file, played as if its sensors were there</source>
        <translation>Un archivo, reproducido como si sus sensores estuvieran aquí</translation>
    </message>
    <message>
        <source>Simulated rig</source>
        <translation>Equipo simulado</translation>
    </message>
    <message>
        <source>Sensors and fruit that do not exist, to learn and to try</source>
        <translation>Sensores y fruta que no existen, para aprender y probar</translation>
    </message>
    <message>
        <source>Sensors that are plugged in</source>
        <translation>Sensores enchufados</translation>
    </message>
    <message>
        <source>Devices that are plugged in appear here by themselves.</source>
        <translation>Los dispositivos que se enchufan aparecen aquí por sí solos.</translation>
    </message>
    <message>
        <source>No device was found. Plug your sensors in and they appear here by themselves. Recordings (MCAP of ROS 2, bag of ROS 1) and the simulated rig work without any.</source>
        <translation>No se encontró ningún dispositivo. Enchufe sus sensores y aparecerán aquí por sí solos. Las grabaciones (MCAP de ROS 2, bag de ROS 1) y el equipo simulado funcionan sin ninguno.</translation>
    </message>
    <message>
        <source>One sensor</source>
        <translation>Un sensor</translation>
    </message>
    <message>
        <source>Two sensors, facing each other</source>
        <translation>Dos sensores, uno frente al otro</translation>
    </message>
    <message>
        <source>Three sensors along the belt</source>
        <translation>Tres sensores a lo largo de la cinta</translation>
    </message>
    <message>
        <source>Four sensors in a ring</source>
        <translation>Cuatro sensores en círculo</translation>
    </message>
    <message>
        <source>Two sensors, fruit that touch, and other things</source>
        <translation>Dos sensores, fruta que se toca y otras cosas</translation>
    </message>
    <message>
        <source>Two sensors over a fast belt</source>
        <translation>Dos sensores sobre una cinta rápida</translation>
    </message>
    <message>
        <source>not there</source>
        <translation>no está</translation>
    </message>
    <message>
        <source>Plug it in again; it starts by itself when it returns.</source>
        <translation>Enchúfelo de nuevo; parte solo cuando vuelve.</translation>
    </message>
    <message>
        <source>no pictures</source>
        <translation>sin imágenes</translation>
    </message>
    <message>
        <source>Check its cable and power; it is opened again by itself.</source>
        <translation>Revise su cable y su alimentación; se abre de nuevo por sí solo.</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>falló</translation>
    </message>
    <message>
        <source>at its end</source>
        <translation>terminó</translation>
    </message>
    <message>
        <source>The recording is over; start it again to see it anew.</source>
        <translation>La grabación terminó; iníciela otra vez para verla de nuevo.</translation>
    </message>
    <message>
        <source>starting</source>
        <translation>partiendo</translation>
    </message>
    <message>
        <source>loses pictures</source>
        <translation>pierde imágenes</translation>
    </message>
    <message>
        <source>Give it a USB controller of its own, and a shorter cable.</source>
        <translation>Déle un controlador USB propio y un cable más corto.</translation>
    </message>
    <message>
        <source>slow</source>
        <translation>lento</translation>
    </message>
    <message>
        <source>This computer cannot keep up: close other programs, or give it a USB controller of its own.</source>
        <translation>Este computador no da abasto: cierre otros programas, o déle al sensor un controlador USB propio.</translation>
    </message>
    <message>
        <source>running</source>
        <translation>funcionando</translation>
    </message>
    <message>
        <source>It is opened again by itself; if it stays away, unplug it and plug it in again.</source>
        <translation>Se abre de nuevo por sí solo; si no vuelve, desenchúfelo y enchúfelo otra vez.</translation>
    </message>
    <message>
        <source>{rate} a second</source>
        <translation>{rate} por segundo</translation>
    </message>
    <message>
        <source>{rate} of {nominal} a second</source>
        <translation>{rate} de {nominal} por segundo</translation>
    </message>
    <message>
        <source>none of {frames}</source>
        <translation>ninguna de {frames}</translation>
    </message>
    <message>
        <source>{drops} of {frames}</source>
        <translation>{drops} de {frames}</translation>
    </message>
    <message>
        <source>A sensor needs a name.</source>
        <translation>Un sensor necesita un nombre.</translation>
    </message>
    <message>
        <source>A name has letters, digits and _ only, and begins with a letter; for example left_1.</source>
        <translation>Un nombre lleva solo letras sin tilde, dígitos y _, y empieza con una letra; por ejemplo izquierda_1.</translation>
    </message>
    <message>
        <source>Another sensor has this name.</source>
        <translation>Otro sensor tiene este nombre.</translation>
    </message>
    <message>
        <source>locked</source>
        <translation>fija</translation>
    </message>
    <message>
        <source>as recorded</source>
        <translation>como se grabó</translation>
    </message>
    <message>
        <source>not known</source>
        <translation>no se sabe</translation>
    </message>
    <message>
        <source>This driver cannot lock them; colours may drift, so keep the light steady.</source>
        <translation>Este controlador no puede fijarlas; los colores pueden variar, así que mantenga la luz pareja.</translation>
    </message>
</context>
<context>
    <name>ConnectPage</name>
    <message>
        <source>Connect</source>
        <translation>Conectar</translation>
    </message>
    <message>
        <source>Connect the sensors of this source</source>
        <translation>Conectar los sensores de esta fuente</translation>
    </message>
    <message>
        <source>Calibrate</source>
        <translation>Calibrar</translation>
    </message>
    <message>
        <source>Go on to calibrating</source>
        <translation>Seguir con la calibración</translation>
    </message>
    <message>
        <source>Other source…</source>
        <translation>Otra fuente…</translation>
    </message>
    <message>
        <source>Connect something else</source>
        <translation>Conectar otra cosa</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Volver</translation>
    </message>
    <message>
        <source>Stay with the sensors that are connected</source>
        <translation>Quedarse con los sensores conectados</translation>
    </message>
    <message>
        <source>Choose the file of a recording, or another source.</source>
        <translation>Elija el archivo de una grabación, u otra fuente.</translation>
    </message>
    <message>
        <source>Choose what shall be connected, then press Connect.</source>
        <translation>Elija qué conectar y luego presione Conectar.</translation>
    </message>
    <message>
        <source>The sensors are being started.</source>
        <translation>Los sensores están partiendo.</translation>
    </message>
    <message>
        <source>The line runs. Sensors can be changed when its lot has ended.</source>
        <translation>La línea está funcionando. Los sensores se pueden cambiar cuando termine su lote.</translation>
    </message>
    <message>
        <source>{running} of {count} sensors run. Look after the others, or leave them out.</source>
        <translation>Funcionan {running} de {count} sensores. Revise los demás, o déjelos fuera.</translation>
    </message>
    <message>
        <source>The sensor runs. Give it a name, then calibrate.</source>
        <translation>El sensor funciona. Póngale un nombre y luego calibre.</translation>
    </message>
    <message>
        <source>{count} sensors run. Give each a name, choose the reference, then calibrate.</source>
        <translation>Funcionan {count} sensores. Póngale un nombre a cada uno, elija la referencia y luego calibre.</translation>
    </message>
    <message>
        <source>Choose a recording</source>
        <translation>Elegir una grabación</translation>
    </message>
    <message>
        <source>Recordings (*.mcap *.bag);;All files (*)</source>
        <translation>Grabaciones (*.mcap *.bag);;Todos los archivos (*)</translation>
    </message>
    <message>
        <source>{sensor} is left out.</source>
        <translation>{sensor} queda fuera.</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Deshacer</translation>
    </message>
</context>
<context>
    <name>SensorDetails</name>
    <message>
        <source>Identify</source>
        <translation>Identificar</translation>
    </message>
    <message>
        <source>Flash the picture of this sensor</source>
        <translation>Hacer destellar la imagen de este sensor</translation>
    </message>
    <message>
        <source>Reference</source>
        <translation>Referencia</translation>
    </message>
    <message>
        <source>Place all other sensors in the frame of this one</source>
        <translation>Ubicar todos los demás sensores respecto de este</translation>
    </message>
    <message>
        <source>Move to the left</source>
        <translation>Mover a la izquierda</translation>
    </message>
    <message>
        <source>Move to the right</source>
        <translation>Mover a la derecha</translation>
    </message>
    <message>
        <source>Leave this sensor out; connect the source again to have it back</source>
        <translation>Dejar fuera este sensor; conecte la fuente de nuevo para recuperarlo</translation>
    </message>
    <message>
        <source>Device</source>
        <translation>Equipo</translation>
    </message>
    <message>
        <source>Serial</source>
        <translation>Serie</translation>
    </message>
    <message>
        <source>Pictures</source>
        <translation>Imágenes</translation>
    </message>
    <message>
        <source>Lost</source>
        <translation>Perdidas</translation>
    </message>
    <message>
        <source>Exposure</source>
        <translation>Exposición</translation>
    </message>
    <message>
        <source>Whether exposure and white balance stay as they are</source>
        <translation>Si la exposición y el balance de blancos se mantienen</translation>
    </message>
    <message>
        <source>Name of the sensor</source>
        <translation>Nombre del sensor</translation>
    </message>
    <message>
        <source>Name of the sensor: letters, digits and _, beginning with a letter</source>
        <translation>Nombre del sensor: letras sin tilde, dígitos y _, empezando con una letra</translation>
    </message>
</context>
<context>
    <name>SensorTile</name>
    <message>
        <source>, reference</source>
        <translation>, referencia</translation>
    </message>
    <message>
        <source>reference</source>
        <translation>referencia</translation>
    </message>
</context>
<context>
    <name>SourceChooser</name>
    <message>
        <source>What shall be connected?</source>
        <translation>¿Qué se va a conectar?</translation>
    </message>
</context>
<context>
    <name>SourceForm</name>
    <message>
        <source>&amp;Rig</source>
        <translation>&amp;Equipo</translation>
    </message>
    <message>
        <source>&amp;Number of the rig</source>
        <translation>&amp;Número del equipo</translation>
    </message>
    <message>
        <source>Belt s&amp;peed</source>
        <translation>&amp;Velocidad de la cinta</translation>
    </message>
    <message>
        <source>Each number stands for sensors put up by other hands, over another belt</source>
        <translation>Cada número representa sensores montados por otras manos, sobre otra cinta</translation>
    </message>
    <message>
        <source>The one before</source>
        <translation>El anterior</translation>
    </message>
    <message>
        <source>The next one</source>
        <translation>El siguiente</translation>
    </message>
    <message>
        <source>Slower</source>
        <translation>Más lenta</translation>
    </message>
    <message>
        <source>Faster</source>
        <translation>Más rápida</translation>
    </message>
    <message>
        <source>Choose a file…</source>
        <translation>Elegir un archivo…</translation>
    </message>
    <message>
        <source>Choose the file of a recording (Ctrl+O)</source>
        <translation>Elegir el archivo de una grabación (Ctrl+O)</translation>
    </message>
    <message>
        <source>Begin again at the end</source>
        <translation>Volver a empezar al final</translation>
    </message>
    <message>
        <source>No file is chosen yet.</source>
        <translation>Aún no se elige ningún archivo.</translation>
    </message>
    <message>
        <source>A recording holds colour, depth and camera info of each sensor: an MCAP file of ROS 2, or a bag of ROS 1. It plays at the speed at which it was recorded.</source>
        <translation>Una grabación contiene color, profundidad y datos de cámara de cada sensor: un archivo MCAP de ROS 2, o un bag de ROS 1. Se reproduce a la velocidad a la que se grabó.</translation>
    </message>
    <message>
        <source>Simulated Kinects over a simulated belt, with the noise and the errors of real ones. Everything works as with real sensors, and the truth is known.</source>
        <translation>Kinects simulados sobre una cinta simulada, con el ruido y los errores de los reales. Todo funciona como con sensores reales, y la verdad se conoce.</translation>
    </message>
    <message>
        <source>These sensors are plugged in. One that is unplugged comes back by itself when it returns.</source>
        <translation>Estos sensores están enchufados. Uno que se desenchufe vuelve por sí solo cuando regresa.</translation>
    </message>
    <message>
        <source>A device that is plugged in.</source>
        <translation>Un dispositivo enchufado.</translation>
    </message>
</context>
<context>
    <name>TurnCard</name>
    <message>
        <source>Projectors take turns</source>
        <translation>Los proyectores se turnan</translation>
    </message>
    <message>
        <source>One sensor blinds no other; its projector is always on.</source>
        <translation>Un solo sensor no encandila a otro; su proyector está siempre encendido.</translation>
    </message>
    <message>
        <source>Until calibration tells which sensors overlap, each is on alone.</source>
        <translation>Hasta que la calibración diga qué sensores se traslapan, cada uno se enciende solo.</translation>
    </message>
    <message>
        <source>No two sensors see the same place; all are on together.</source>
        <translation>Ningún par de sensores ve el mismo lugar; todos se encienden juntos.</translation>
    </message>
    <message>
        <source>Projectors</source>
        <translation>Proyectores</translation>
    </message>
    <message>
        <source>{low} to {high} pictures a second; belt up to {speed}</source>
        <translation>{low} a {high} imágenes por segundo; cinta hasta {speed}</translation>
    </message>
    <message>
        <source>{low} of {nominal} pictures a second each; belt up to {speed}</source>
        <translation>{low} de {nominal} imágenes por segundo cada uno; cinta hasta {speed}</translation>
    </message>
    <message>
        <source>{low} pictures a second each; belt up to {speed}</source>
        <translation>{low} imágenes por segundo cada uno; cinta hasta {speed}</translation>
    </message>
    <message>
        <source>These blind each other, as a projector of theirs cannot be switched: {pairs}.</source>
        <translation>Estos se deslumbran entre sí, porque un proyector suyo no se puede apagar: {pairs}.</translation>
    </message>
    <message>
        <source>The light of these sensors does not disturb the others; none has to wait.</source>
        <translation>La luz de estos sensores no estorba a los demás; ninguno tiene que esperar.</translation>
    </message>
    <message>
        <source>Sensors that see the same place are never on together.</source>
        <translation>Los sensores que ven el mismo lugar nunca se encienden juntos.</translation>
    </message>
</context>
</TS>
