<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="es">
<context>
    <name>CheckedSensorCard</name>
    <message>
        <source>firmware {version}</source>
        <translation>firmware {version}</translation>
    </message>
</context>
<context>
    <name>Checkup</name>
    <message>
        <source>No depth sensor was found on this computer.</source>
        <translation>No se encontró ningún sensor de profundidad en este computador.</translation>
    </message>
    <message>
        <source>Plug one in straight at the computer, switch its power supply on, and check again after ten seconds.</source>
        <translation>Enchufe uno directamente en el computador, encienda su fuente de poder y revise de nuevo después de diez segundos.</translation>
    </message>
    <message>
        <source>No depth sensor was found: this system shows no USB at all.</source>
        <translation>No se encontró ningún sensor de profundidad: este sistema no muestra ningún USB.</translation>
    </message>
    <message>
        <source>In a virtual machine or a container, hand the computer&apos;s USB devices on to it. On a computer, look in its BIOS whether USB is switched off.</source>
        <translation>En una máquina virtual o un contenedor, pásele los dispositivos USB del computador. En un computador, vea en su BIOS si el USB está apagado.</translation>
    </message>
    <message>
        <source>{sensors} share one USB controller ({controller}); it has room for one Kinect with colour and depth.</source>
        <translation>{sensors} comparten un controlador USB ({controller}); en él cabe un solo Kinect con color y profundidad.</translation>
    </message>
    <message>
        <source>Controller {free} has room: try one sensor in other sockets until this check shows it there.</source>
        <translation>En el controlador {free} hay lugar: pruebe un sensor en otros puertos hasta que esta revisión lo muestre allí.</translation>
    </message>
    <message>
        <source>No other controller with room is known here: try other sockets, or add a USB card for each further Kinect.</source>
        <translation>No se conoce aquí otro controlador con lugar: pruebe otros puertos, o agregue una tarjeta USB por cada Kinect más.</translation>
    </message>
    <message>
        <source>{sensors} share one USB controller ({controller}), which is sure to carry one Kinect with colour and depth; they ran without loss now.</source>
        <translation>{sensors} comparten un controlador USB ({controller}), que de seguro lleva un Kinect con color y profundidad; ahora funcionaron sin pérdidas.</translation>
    </message>
    <message>
        <source>Watch whether it stays so. If not, give one of them another controller.</source>
        <translation>Observe si sigue así. Si no, déle a uno de ellos otro controlador.</translation>
    </message>
    <message>
        <source>All programs together may hold {have} MB for USB, and these sensors need {need} MB.</source>
        <translation>Todos los programas juntos pueden ocupar {have} MB para USB, y estos sensores necesitan {need} MB.</translation>
    </message>
    <message>
        <source>As the administrator: echo {want} &gt; /sys/module/usbcore/parameters/usbfs_memory_mb; to keep it, add usbcore.usbfs_memory_mb={want} to the kernel&apos;s command line.</source>
        <translation>Como administrador: echo {want} &gt; /sys/module/usbcore/parameters/usbfs_memory_mb; para que quede, agregue usbcore.usbfs_memory_mb={want} a la línea de comandos del núcleo.</translation>
    </message>
    <message>
        <source>The driver for {make} does not answer.</source>
        <translation>El controlador de software para {make} no responde.</translation>
    </message>
    <message>
        <source>Unplug these sensors, plug them in again, and check again. If it stays so, restart the computer.</source>
        <translation>Desenchufe estos sensores, enchúfelos de nuevo y revise otra vez. Si sigue igual, reinicie el computador.</translation>
    </message>
    <message>
        <source>The driver for {make} failed: {why}.</source>
        <translation>El controlador de software para {make} falló: {why}.</translation>
    </message>
    <message>
        <source>Unplug these sensors and plug them in again. If it stays so, install the program again.</source>
        <translation>Desenchufe estos sensores y enchúfelos de nuevo. Si sigue igual, instale el programa otra vez.</translation>
    </message>
    <message>
        <source>A Kinect shows its motor but no camera: it has no power.</source>
        <translation>Un Kinect muestra su motor, pero no su cámara: no tiene corriente.</translation>
    </message>
    <message>
        <source>Plug in its power supply, at the wall and at the cable. USB alone does not feed a Kinect.</source>
        <translation>Enchufe su fuente de poder, en la pared y en el cable. El USB solo no alimenta a un Kinect.</translation>
    </message>
    <message>
        <source>There is no driver for {model} in this version.</source>
        <translation>En esta versión no hay controlador de software para {model}.</translation>
    </message>
    <message>
        <source>Use a sensor that is supported, or record it with ROS 2 and open the recording.</source>
        <translation>Use un sensor compatible, o grábelo con ROS 2 y abra la grabación.</translation>
    </message>
    <message>
        <source>The system does not let you use it.</source>
        <translation>El sistema no le permite usarlo.</translation>
    </message>
    <message>
        <source>Press “Let me use them…”. Then unplug it and plug it in again.</source>
        <translation>Presione «Permitir usarlos…». Luego desenchúfelo y enchúfelo de nuevo.</translation>
    </message>
    <message>
        <source>The system does not let you use it, although the rules are installed.</source>
        <translation>El sistema no le permite usarlo, aunque las reglas están instaladas.</translation>
    </message>
    <message>
        <source>Unplug it and plug it in again. If it stays so, restart the computer.</source>
        <translation>Desenchúfelo y enchúfelo de nuevo. Si sigue igual, reinicie el computador.</translation>
    </message>
    <message>
        <source>The system knows it, but shows no file to use it through ({node}).</source>
        <translation>El sistema lo conoce, pero no muestra el archivo por el que se usa ({node}).</translation>
    </message>
    <message>
        <source>In a container, hand /dev/bus/usb on to it. Else unplug it and plug it in again.</source>
        <translation>En un contenedor, pásele /dev/bus/usb. Si no, desenchúfelo y enchúfelo de nuevo.</translation>
    </message>
    <message>
        <source>Another program has it open: {programs}.</source>
        <translation>Otro programa lo tiene abierto: {programs}.</translation>
    </message>
    <message>
        <source>Close that program, then check again.</source>
        <translation>Cierre ese programa y revise de nuevo.</translation>
    </message>
    <message>
        <source>The system uses it as a webcam ({driver}).</source>
        <translation>El sistema lo usa como cámara web ({driver}).</translation>
    </message>
    <message>
        <source>It is taken over when it runs. If that fails: sudo modprobe -r {driver}</source>
        <translation>Se le quita al sistema cuando funciona. Si eso falla: sudo modprobe -r {driver}</translation>
    </message>
    <message>
        <source>It runs at {speed} Mbit/s and needs {needed} Mbit/s to give all its pictures.</source>
        <translation>Funciona a {speed} Mbit/s y necesita {needed} Mbit/s para dar todas sus imágenes.</translation>
    </message>
    <message>
        <source>Use the cable that came with it, straight at the computer, in a socket of USB {usb}. Those of USB 3 are mostly blue.</source>
        <translation>Use el cable que vino con él, directamente en el computador, en un puerto USB {usb}. Los de USB 3 suelen ser azules.</translation>
    </message>
    <message>
        <source>It is plugged in, but its driver does not find it.</source>
        <translation>Está enchufado, pero su controlador de software no lo encuentra.</translation>
    </message>
    <message>
        <source>Unplug it and plug it in again, with its power supply.</source>
        <translation>Desenchúfelo y enchúfelo de nuevo, con su fuente de poder.</translation>
    </message>
    <message>
        <source>It has the same serial as another sensor, or none: they cannot be told apart.</source>
        <translation>Tiene la misma serie que otro sensor, o ninguna: no se pueden distinguir.</translation>
    </message>
    <message>
        <source>Use one of them only, or one of another model.</source>
        <translation>Use solo uno de ellos, o uno de otro modelo.</translation>
    </message>
    <message>
        <source>It has no serial: it can be run only as long as no other of its make is plugged in.</source>
        <translation>No tiene serie: solo puede funcionar mientras no haya conectado otro de su fabricante.</translation>
    </message>
    <message>
        <source>Plug in only this one. Where connecting does not list it, the line needs one that has a serial.</source>
        <translation>Conecte solo este. Si al conectar no aparece en la lista, la línea necesita uno que tenga serie.</translation>
    </message>
    <message>
        <source>It cannot be opened: the system does not let you, or another sensor has its serial.</source>
        <translation>No se puede abrir: el sistema no se lo permite, u otro sensor tiene su serie.</translation>
    </message>
    <message>
        <source>Press “Let me use them…”. Of two with one serial, plug in only one.</source>
        <translation>Presione «Permitir usarlos…». De dos con la misma serie, enchufe uno solo.</translation>
    </message>
    <message>
        <source>Its driver hangs.</source>
        <translation>Su controlador de software se quedó pegado.</translation>
    </message>
    <message>
        <source>Unplug it and plug it in again, then check again.</source>
        <translation>Desenchúfelo, enchúfelo de nuevo y revise otra vez.</translation>
    </message>
    <message>
        <source>It gave no picture in {seconds} s.</source>
        <translation>No dio ninguna imagen en {seconds} s.</translation>
    </message>
    <message>
        <source>Check its power supply and cable; give it a socket of its own, not on a hub.</source>
        <translation>Revise su fuente de poder y su cable; déle un puerto propio, sin concentrador.</translation>
    </message>
    <message>
        <source>It stopped giving pictures while it was watched.</source>
        <translation>Dejó de dar imágenes mientras se lo observaba.</translation>
    </message>
    <message>
        <source>Check that its plugs sit firmly, and its power supply.</source>
        <translation>Revise que sus enchufes estén firmes, y su fuente de poder.</translation>
    </message>
    <message>
        <source>It gives {rate} of {nominal} pictures a second.</source>
        <translation>Da {rate} de {nominal} imágenes por segundo.</translation>
    </message>
    <message>
        <source>Give it a USB controller of its own, and close other programs.</source>
        <translation>Déle un controlador USB propio y cierre otros programas.</translation>
    </message>
    <message>
        <source>It lost {lost} of {all} pictures, though this computer had time to take them.</source>
        <translation>Perdió {lost} de {all} imágenes, aunque este computador tenía tiempo para recibirlas.</translation>
    </message>
    <message>
        <source>Use a shorter cable without a hub, and a USB controller of its own.</source>
        <translation>Use un cable más corto, sin concentrador, y un controlador USB propio.</translation>
    </message>
    <message>
        <source>It lost {lost} of {all} pictures; this computer was too busy to take some of them: {late} ms late at worst, and a sensor waits some {holds} ms.</source>
        <translation>Perdió {lost} de {all} imágenes; este computador estaba demasiado ocupado para recibir algunas: se retrasó hasta {late} ms, y un sensor espera unos {holds} ms.</translation>
    </message>
    <message>
        <source>Close other programs and check again. If pictures are lost then too, and this computer is said to have time, it is the cable or the USB controller.</source>
        <translation>Cierre otros programas y revise de nuevo. Si también entonces se pierden imágenes, y se dice que este computador tenía tiempo, es el cable o el controlador USB.</translation>
    </message>
    <message>
        <source>ready</source>
        <translation>listo</translation>
    </message>
    <message>
        <source>runs</source>
        <translation>funciona</translation>
    </message>
    <message>
        <source>no pictures</source>
        <translation>sin imágenes</translation>
    </message>
    <message>
        <source>failed</source>
        <translation>falló</translation>
    </message>
    <message>
        <source>hangs</source>
        <translation>pegado</translation>
    </message>
    <message>
        <source>in use</source>
        <translation>en uso</translation>
    </message>
    <message>
        <source>no access</source>
        <translation>sin acceso</translation>
    </message>
    <message>
        <source>no driver</source>
        <translation>sin controlador</translation>
    </message>
    <message>
        <source>{rate} pictures a second, none lost</source>
        <translation>{rate} imágenes por segundo, ninguna perdida</translation>
    </message>
    <message>
        <source>{rate} pictures a second, {lost} of {all} lost</source>
        <translation>{rate} imágenes por segundo, {lost} de {all} perdidas</translation>
    </message>
    <message>
        <source>Port {port} of USB controller {controller}</source>
        <translation>Puerto {port} del controlador USB {controller}</translation>
    </message>
    <message>
        <source>USB bus {bus}</source>
        <translation>Bus USB {bus}</translation>
    </message>
    <message>
        <source>No sensor was found.</source>
        <translation>No se encontró ningún sensor.</translation>
    </message>
    <message>
        <source>1 sensor</source>
        <translation>1 sensor</translation>
    </message>
    <message>
        <source>{n} sensors</source>
        <translation>{n} sensores</translation>
    </message>
    <message>
        <source>{sensors}; nothing is wrong.</source>
        <translation>{sensors}; no hay problemas.</translation>
    </message>
    <message>
        <source>{sensors}; one thing is wrong.</source>
        <translation>{sensors}; hay un problema.</translation>
    </message>
    <message>
        <source>{sensors}; {n} things are wrong.</source>
        <translation>{sensors}; hay {n} problemas.</translation>
    </message>
    <message>
        <source>Looking at the USB</source>
        <translation>Mirando el USB</translation>
    </message>
    <message>
        <source>Asking the drivers</source>
        <translation>Preguntando a los controladores</translation>
    </message>
    <message>
        <source>Starting the sensors</source>
        <translation>Iniciando los sensores</translation>
    </message>
    <message>
        <source>Watching the sensors run</source>
        <translation>Observando cómo funcionan los sensores</translation>
    </message>
</context>
<context>
    <name>CheckupDialog</name>
    <message>
        <source>Checking the sensors</source>
        <translation>Revisando los sensores</translation>
    </message>
    <message>
        <source>Sensors and USB</source>
        <translation>Sensores y USB</translation>
    </message>
    <message>
        <source>Check again</source>
        <translation>Revisar de nuevo</translation>
    </message>
    <message>
        <source>Look at all sensors anew</source>
        <translation>Mirar todos los sensores otra vez</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Detener</translation>
    </message>
    <message>
        <source>Stop checking</source>
        <translation>Dejar de revisar</translation>
    </message>
    <message>
        <source>Copy</source>
        <translation>Copiar</translation>
    </message>
    <message>
        <source>Copy all of it as text, for whoever helps you</source>
        <translation>Copiar todo como texto, para quien le ayude</translation>
    </message>
    <message>
        <source>Let me use them…</source>
        <translation>Permitir usarlos…</translation>
    </message>
    <message>
        <source>Install the rules that let everybody use them</source>
        <translation>Instalar las reglas que permiten a todos usarlos</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Cerrar</translation>
    </message>
    <message>
        <source>Go back to the sensors</source>
        <translation>Volver a los sensores</translation>
    </message>
    <message>
        <source>Every sensor appears here, with the USB controller that carries it and what is wrong.</source>
        <translation>Aquí aparece cada sensor, con el controlador USB que lo lleva y lo que anda mal.</translation>
    </message>
    <message>
        <source>The check was stopped.</source>
        <translation>La revisión se detuvo.</translation>
    </message>
    <message>
        <source>Stopping …</source>
        <translation>Deteniendo …</translation>
    </message>
    <message>
        <source>Installing the rules</source>
        <translation>Instalando las reglas</translation>
    </message>
    <message>
        <source>The rules are installed. Unplug the sensors, plug them in again, and check again.</source>
        <translation>Las reglas están instaladas. Desenchufe los sensores, enchúfelos de nuevo y revise otra vez.</translation>
    </message>
</context>
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
        <source>Devices that are plugged in appear here by themselves. If one does not, press “Check sensors…”.</source>
        <translation>Los dispositivos que se enchufan aparecen aquí por sí solos. Si alguno no aparece, presione «Revisar sensores…».</translation>
    </message>
    <message>
        <source>No device was found. Plug your sensors in and they appear here by themselves; if one does not, press “Check sensors…”. Recordings (MCAP of ROS 2, bag of ROS 1) and the simulated rig work without any.</source>
        <translation>No se encontró ningún dispositivo. Enchufe sus sensores y aparecen aquí por sí solos; si alguno no aparece, presione «Revisar sensores…». Las grabaciones (MCAP de ROS 2, bag de ROS 1) y el equipo simulado funcionan sin ninguno.</translation>
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
        <source>Two sensors whose projectors take turns</source>
        <translation>Dos sensores cuyos proyectores se turnan</translation>
    </message>
    <message>
        <source>Two sensors whose depth is off</source>
        <translation>Dos sensores con error de profundidad</translation>
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
        <source>does not answer</source>
        <translation>no responde</translation>
    </message>
    <message>
        <source>Its driver hangs. Unplug it, wait five seconds, and plug it in again.</source>
        <translation>Su controlador no responde. Desenchúfelo, espere cinco segundos y enchúfelo de nuevo.</translation>
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
        <source>being measured</source>
        <translation>se mide</translation>
    </message>
    <message>
        <source>The projector of {sensors} may be on out of its turn, as it does not answer.</source>
        <translation>El proyector de {sensors} puede estar encendido fuera de su turno, porque no responde.</translation>
    </message>
    <message>
        <source>may be blinded</source>
        <translation>puede estar deslumbrado</translation>
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
        <source>adjusting to the light</source>
        <translation>ajustándose a la luz</translation>
    </message>
    <message>
        <source>automatic</source>
        <translation>automática</translation>
    </message>
    <message>
        <source>This sensor cannot lock them; colours may drift, so keep the light steady.</source>
        <translation>Este sensor no puede fijarlas; los colores pueden variar, así que mantenga la luz pareja.</translation>
    </message>
    <message>
        <source>as recorded</source>
        <translation>como se grabó</translation>
    </message>
    <message>
        <source>steady for {time}</source>
        <translation>estable desde hace {time}</translation>
    </message>
    <message>
        <source>{rate} a minute</source>
        <translation>{rate} por minuto</translation>
    </message>
    <message>
        <source>Wait until its depth is steady before you calibrate or correct it.</source>
        <translation>Espere a que su profundidad sea estable antes de calibrarlo o corregirlo.</translation>
    </message>
    <message>
        <source>watched for {time}</source>
        <translation>en observación desde hace {time}</translation>
    </message>
    <message>
        <source>not watched yet</source>
        <translation>sin observar aún</translation>
    </message>
    <message>
        <source>not known yet</source>
        <translation>aún no se sabe</translation>
    </message>
    <message>
        <source>Bring the light back, or start the sensors again so that they adjust to it.</source>
        <translation>Restablezca la luz o reinicie los sensores para que se ajusten a ella.</translation>
    </message>
    <message>
        <source>belt of another colour than at first</source>
        <translation>cinta de otro color que al principio</translation>
    </message>
    <message>
        <source>belt much brighter than at first</source>
        <translation>cinta mucho más clara que al principio</translation>
    </message>
    <message>
        <source>belt much darker than at first</source>
        <translation>cinta mucho más oscura que al principio</translation>
    </message>
    <message>
        <source>as at first</source>
        <translation>como al principio</translation>
    </message>
    <message>
        <source>not corrected</source>
        <translation>sin corregir</translation>
    </message>
    <message>
        <source>corrected</source>
        <translation>corregida</translation>
    </message>
    <message>
        <source>corrected, {half}</source>
        <translation>corregida, {half}</translation>
    </message>
    <message>
        <source>corrected, {half}, {day}</source>
        <translation>corregida, {half}, {day}</translation>
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
        <source>Start again</source>
        <translation>Iniciar de nuevo</translation>
    </message>
    <message>
        <source>Start the sensors of this source again</source>
        <translation>Iniciar de nuevo los sensores de esta fuente</translation>
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
        <source>Check sensors…</source>
        <translation>Revisar sensores…</translation>
    </message>
    <message>
        <source>See what is connected and what is wrong</source>
        <translation>Ver qué está conectado y qué anda mal</translation>
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
        <source>The sensors are being recorded. They can be changed when the recording has ended.</source>
        <translation>Los sensores se están grabando. Se pueden cambiar cuando termine la grabación.</translation>
    </message>
    <message>
        <source>The projectors are being measured; pictures come and go meanwhile.</source>
        <translation>Se miden los proyectores; mientras tanto las imágenes van y vienen.</translation>
    </message>
    <message>
        <source>No sensor runs. Start them again, or connect another source.</source>
        <translation>Ningún sensor funciona. Inícielos de nuevo o conecte otra fuente.</translation>
    </message>
    <message>
        <source>The recording is over. Start it again, or connect another source.</source>
        <translation>La grabación terminó. Iníciela de nuevo o conecte otra fuente.</translation>
    </message>
    <message>
        <source>{running} of {count} sensors run. Look after the others, or leave them out.</source>
        <translation>Funcionan {running} de {count} sensores. Revise los demás, o déjelos fuera.</translation>
    </message>
    <message>
        <source>All sensors run, and they are calibrated.</source>
        <translation>Todos los sensores funcionan y están calibrados.</translation>
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
</context>
<context>
    <name>ControllerCard</name>
    <message>
        <source>USB controllers</source>
        <translation>Controladores USB</translation>
    </message>
    <message>
        <source>Controller</source>
        <translation>Controlador</translation>
    </message>
    <message>
        <source>Sensors</source>
        <translation>Sensores</translation>
    </message>
    <message>
        <source>Room for Kinects taken</source>
        <translation>Lugar para Kinects ocupado</translation>
    </message>
</context>
<context>
    <name>Depth</name>
    <message>
        <source>Belt</source>
        <translation>Cinta</translation>
    </message>
    <message>
        <source>Box</source>
        <translation>Caja</translation>
    </message>
    <message>
        <source>Ball</source>
        <translation>Pelota</translation>
    </message>
    <message>
        <source>Higher</source>
        <translation>Más alto</translation>
    </message>
    <message>
        <source>Result</source>
        <translation>Resultado</translation>
    </message>
    <message>
        <source>1.  Stop the belt and clear it.</source>
        <translation>1.  Detenga la cinta y despéjela.</translation>
    </message>
    <message>
        <source>3.  Measure from the sensor&apos;s glass straight ahead to the belt, to the cross in the picture, and type it. Leave it at 0 if you have no tape.</source>
        <translation>3.  Mida desde el cristal del sensor, en línea recta, hasta la cinta, donde está la cruz de la imagen, y escríbalo. Deje 0 si no tiene huincha.</translation>
    </message>
    <message>
        <source>2.  If the sensor can only be lowered, lower it by 20 cm or more now: the second height is its own place.</source>
        <translation>2.  Si el sensor solo se puede bajar, bájelo ahora 20 cm o más: la segunda altura es su propio lugar.</translation>
    </message>
    <message>
        <source>1.  Put a carton or a box with a flat, dull lid amid the picture; the higher the better.</source>
        <translation>1.  Ponga un cartón o una caja de tapa plana y mate en el centro de la imagen; cuanto más alta, mejor.</translation>
    </message>
    <message>
        <source>2.  Measure the height of its upper side over the belt, and type it.</source>
        <translation>2.  Mida la altura de su cara superior sobre la cinta y escríbala.</translation>
    </message>
    <message>
        <source>1.  Put a dull ball on the bare belt amid the picture; a large one tells more.</source>
        <translation>1.  Ponga una pelota mate sobre la cinta vacía, en el centro de la imagen; una grande dice más.</translation>
    </message>
    <message>
        <source>2.  Measure its diameter between two straight edges, and type it.</source>
        <translation>2.  Mida su diámetro entre dos cantos rectos y escríbalo.</translation>
    </message>
    <message>
        <source>1.  Clear the belt, and raise the sensor straight up by 20 cm or more: on a block, or in its clamp.</source>
        <translation>1.  Despeje la cinta, y suba el sensor derecho hacia arriba 20 cm o más: sobre un taco, o en su soporte.</translation>
    </message>
    <message>
        <source>2.  Measure how much higher its glass is now than at first, straight up, and type it.</source>
        <translation>2.  Mida cuánto más alto está ahora su cristal que al principio, en vertical, y escríbalo.</translation>
    </message>
    <message>
        <source>Known so far: scale ±{scale} %, offset ±{offset} mm. With this raise: about ±{scale2} %, ±{offset2} mm.</source>
        <translation>Hasta ahora se sabe: escala ±{scale} %, desplazamiento ±{offset} mm. Subiéndolo así: unos ±{scale2} %, ±{offset2} mm.</translation>
    </message>
    <message>
        <source>Looking…</source>
        <translation>Mirando…</translation>
    </message>
    <message>
        <source>Something moves: stop the belt, and keep hands away.</source>
        <translation>Algo se mueve: pare la cinta y retire las manos.</translation>
    </message>
    <message>
        <source>No belt is seen yet.</source>
        <translation>Aún no se ve la cinta.</translation>
    </message>
    <message>
        <source>The belt is seen, about {length} away.</source>
        <translation>Se ve la cinta, a unos {length}.</translation>
    </message>
    <message>
        <source>No ball of {length} is seen yet.</source>
        <translation>Aún no se ve ninguna pelota de {length}.</translation>
    </message>
    <message>
        <source>The ball is seen.</source>
        <translation>Se ve la pelota.</translation>
    </message>
    <message>
        <source>No flat lid above the belt is seen yet.</source>
        <translation>Aún no se ve ninguna tapa plana sobre la cinta.</translation>
    </message>
    <message>
        <source>A lid is seen about {length} above the belt; that is not what is typed.</source>
        <translation>Se ve una tapa a unos {length} sobre la cinta; no es lo que está escrito.</translation>
    </message>
    <message>
        <source>The lid is seen, about {length} above the belt.</source>
        <translation>Se ve la tapa, a unos {length} sobre la cinta.</translation>
    </message>
    <message>
        <source>The two heights are too near to each other: raise it by {length} or more.</source>
        <translation>Las dos alturas están muy cerca una de otra: súbalo {length} o más.</translation>
    </message>
    <message>
        <source>The belt is not seen from there: let the sensor look at it.</source>
        <translation>Desde ahí no se ve la cinta: haga que el sensor la mire.</translation>
    </message>
    <message>
        <source>The sensor hangs lower than at first: begin again from here, then raise it.</source>
        <translation>El sensor está más abajo que al principio: empiece de nuevo desde aquí, y luego súbalo.</translation>
    </message>
    <message>
        <source>The sensor hangs where it was: raise it.</source>
        <translation>El sensor está donde estaba: súbalo.</translation>
    </message>
    <message>
        <source>The belt is seen about {length} farther away.</source>
        <translation>Se ve la cinta unos {length} más lejos.</translation>
    </message>
    <message>
        <source>The belt is seen about {length} farther away; that is not what is typed.</source>
        <translation>Se ve la cinta unos {length} más lejos; no es lo que está escrito.</translation>
    </message>
    <message>
        <source>Distance of the belt</source>
        <translation>Distancia de la cinta</translation>
    </message>
    <message>
        <source>Height of the box</source>
        <translation>Altura de la caja</translation>
    </message>
    <message>
        <source>How far the sensor was raised</source>
        <translation>Cuánto se subió el sensor</translation>
    </message>
    <message>
        <source>Diameter of the ball</source>
        <translation>Diámetro de la pelota</translation>
    </message>
    <message>
        <source>Unevenness of the belt</source>
        <translation>Irregularidad de la cinta</translation>
    </message>
    <message>
        <source>the distance of the belt</source>
        <translation>la distancia de la cinta</translation>
    </message>
    <message>
        <source>the height of the box</source>
        <translation>la altura de la caja</translation>
    </message>
    <message>
        <source>how far the sensor was raised</source>
        <translation>cuánto se subió el sensor</translation>
    </message>
    <message>
        <source>the diameter of the ball</source>
        <translation>el diámetro de la pelota</translation>
    </message>
    <message>
        <source>Depth at the belt is now right to ±{after}; without a measurement such a sensor may be off by ±{before}.</source>
        <translation>La profundidad en la cinta es ahora correcta a ±{after}; sin medirlo, un sensor así puede equivocarse en ±{before}.</translation>
    </message>
    <message>
        <source>one height alone</source>
        <translation>una sola altura</translation>
    </message>
    <message>
        <source>{count} heights</source>
        <translation>{count} alturas</translation>
    </message>
    <message>
        <source>one height and the ball</source>
        <translation>una altura y la pelota</translation>
    </message>
    <message>
        <source>all of it</source>
        <translation>todo junto</translation>
    </message>
    <message>
        <source>scale {value} ± {half} %</source>
        <translation>escala {value} ± {half} %</translation>
    </message>
    <message>
        <source>offset {value} ± {half} mm</source>
        <translation>desplazamiento {value} ± {half} mm</translation>
    </message>
    <message>
        <source>bend at the picture&apos;s edge {value} ± {half} %</source>
        <translation>curvatura en el borde de la imagen {value} ± {half} %</translation>
    </message>
    <message>
        <source>Without a tape or a large ball the offset stays unknown: heights are right, widths less.</source>
        <translation>Sin huincha ni pelota grande, el desplazamiento queda sin conocer: las alturas son correctas; los anchos, menos.</translation>
    </message>
    <message>
        <source>A higher box, or the sensor raised farther, would tell the scale.</source>
        <translation>Una caja más alta, o el sensor más arriba, diría la escala.</translation>
    </message>
    <message>
        <source>Take a box or a ball of known size, or raise the sensor, as well.</source>
        <translation>Tome también una caja o una pelota de tamaño conocido, o suba el sensor.</translation>
    </message>
    <message>
        <source>Use a higher box, 15 cm or more, or raise the sensor farther, and use a tape.</source>
        <translation>Use una caja más alta, de 15 cm o más, o suba más el sensor, y use una huincha.</translation>
    </message>
    <message>
        <source>{what} Most in doubt: {length}.</source>
        <translation>{what} Lo más dudoso: {length}.</translation>
    </message>
    <message>
        <source>The belt fills too little of the picture to tell how it bends.</source>
        <translation>La cinta ocupa muy poco de la imagen para saber cómo se curva.</translation>
    </message>
    <message>
        <source>No belt was seen.</source>
        <translation>No se vio la cinta.</translation>
    </message>
    <message>
        <source>Let the sensor look at the bare belt from half a metre to two metres.</source>
        <translation>Haga que el sensor mire la cinta vacía desde medio metro a dos metros.</translation>
    </message>
    <message>
        <source>No flat lid was seen above the belt.</source>
        <translation>No se vio ninguna tapa plana sobre la cinta.</translation>
    </message>
    <message>
        <source>Use a flat, dull lid of at least 15 × 15 cm, level and amid the picture.</source>
        <translation>Use una tapa plana y mate de al menos 15 × 15 cm, a nivel y en el centro de la imagen.</translation>
    </message>
    <message>
        <source>No ball of the typed size was seen.</source>
        <translation>No se vio ninguna pelota del tamaño escrito.</translation>
    </message>
    <message>
        <source>Put one dull ball on the bare belt amid the picture, and type its diameter.</source>
        <translation>Ponga una pelota mate sobre la cinta vacía, en el centro de la imagen, y escriba su diámetro.</translation>
    </message>
    <message>
        <source>Belt or lid is not flat.</source>
        <translation>La cinta o la tapa no es plana.</translation>
    </message>
    <message>
        <source>Use a stiff board, or a place where the belt lies on its table.</source>
        <translation>Use una tabla rígida, o un lugar donde la cinta se apoye en su mesa.</translation>
    </message>
    <message>
        <source>Something moved while pictures were taken.</source>
        <translation>Algo se movió mientras se tomaban imágenes.</translation>
    </message>
    <message>
        <source>Stop the belt, and keep hands away.</source>
        <translation>Detenga la cinta y retire las manos.</translation>
    </message>
    <message>
        <source>Sensor or belt was moved between two measurements.</source>
        <translation>El sensor o la cinta se movió entre dos mediciones.</translation>
    </message>
    <message>
        <source>Begin again with the bare belt.</source>
        <translation>Empiece de nuevo con la cinta vacía.</translation>
    </message>
    <message>
        <source>The box is not as high as was typed.</source>
        <translation>La caja no tiene la altura escrita.</translation>
    </message>
    <message>
        <source>Type the height of its upper side over the belt, in millimetres.</source>
        <translation>Escriba la altura de su cara superior sobre la cinta, en milímetros.</translation>
    </message>
    <message>
        <source>The belt was not seen by the raised sensor.</source>
        <translation>El sensor subido no vio la cinta.</translation>
    </message>
    <message>
        <source>Clear the belt, and raise the sensor straight up, so that it still looks at the belt.</source>
        <translation>Despeje la cinta, y suba el sensor derecho hacia arriba, de modo que siga mirando la cinta.</translation>
    </message>
    <message>
        <source>The two heights of the sensor are too near to each other.</source>
        <translation>Las dos alturas del sensor están muy cerca una de otra.</translation>
    </message>
    <message>
        <source>Raise it by 20 cm or more.</source>
        <translation>Súbalo 20 cm o más.</translation>
    </message>
    <message>
        <source>The sensor was not raised by as much as was typed.</source>
        <translation>El sensor no se subió tanto como se escribió.</translation>
    </message>
    <message>
        <source>Measure how much higher its glass is than at first, straight up, and type it in millimetres.</source>
        <translation>Mida cuánto más alto está su cristal que al principio, en vertical, y escríbalo en milímetros.</translation>
    </message>
    <message>
        <source>One height alone tells nothing.</source>
        <translation>Una sola altura no dice nada.</translation>
    </message>
    <message>
        <source>The heights are too small to tell more than is known of such devices.</source>
        <translation>Las alturas son demasiado pequeñas para decir más de lo que se sabe de esos aparatos.</translation>
    </message>
    <message>
        <source>What was typed does not agree with the other measurements.</source>
        <translation>Lo escrito no concuerda con las demás mediciones.</translation>
    </message>
    <message>
        <source>Measure again; see that the ball lies on the belt itself and that the lid is level.</source>
        <translation>Mida de nuevo; compruebe que la pelota está sobre la propia cinta y que la tapa está a nivel.</translation>
    </message>
    <message>
        <source>No working sensor errs as much as this would mean.</source>
        <translation>Ningún sensor que funcione se equivoca tanto como esto supondría.</translation>
    </message>
    <message>
        <source>Check what was typed, in millimetres.</source>
        <translation>Compruebe lo escrito, en milímetros.</translation>
    </message>
    <message>
        <source>Taking pictures: keep hands away</source>
        <translation>Tomando imágenes: retire las manos</translation>
    </message>
    <message>
        <source>Working out the correction</source>
        <translation>Calculando la corrección</translation>
    </message>
</context>
<context>
    <name>DepthWizard</name>
    <message>
        <source>Keep hands away; it takes some seconds.</source>
        <translation>Retire las manos; tarda unos segundos.</translation>
    </message>
    <message>
        <source>Do as the picture shows, then press Take.</source>
        <translation>Haga lo que muestra el dibujo y presione Tomar.</translation>
    </message>
    <message>
        <source>Keep it, put the sensor back, and calibrate again: every length that it measures changes.</source>
        <translation>Guárdela, devuelva el sensor a su lugar, y calibre de nuevo: toda longitud que mide cambia.</translation>
    </message>
    <message>
        <source>Keep it, and calibrate again: every length that this sensor measures changes with it.</source>
        <translation>Guárdela y calibre de nuevo: toda longitud que mide este sensor cambia con ella.</translation>
    </message>
    <message>
        <source>Do what is said, and measure again.</source>
        <translation>Haga lo que se indica y mida de nuevo.</translation>
    </message>
    <message>
        <source>Depth of {sensor}</source>
        <translation>Profundidad de {sensor}</translation>
    </message>
    <message>
        <source>This sensor still warms up: measured later it is measured better.</source>
        <translation>Este sensor aún se calienta: más tarde se medirá mejor.</translation>
    </message>
    <message>
        <source>Measuring depth</source>
        <translation>Midiendo la profundidad</translation>
    </message>
    <message>
        <source>Working out the correction</source>
        <translation>Calculando la corrección</translation>
    </message>
    <message>
        <source>The depth of {sensor} is corrected from now on.</source>
        <translation>La profundidad de {sensor} se corrige desde ahora.</translation>
    </message>
    <message>
        <source>The depth of {sensor} is used as the device gives it.</source>
        <translation>La profundidad de {sensor} se usa tal como la da el aparato.</translation>
    </message>
    <message>
        <source>Calibrate again.</source>
        <translation>Calibre de nuevo.</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Deshacer</translation>
    </message>
</context>
<context>
    <name>Driver</name>
    <message>
        <source>The library for Kinects is not installed.</source>
        <translation>La biblioteca para los Kinects no está instalada.</translation>
    </message>
    <message>
        <source>In a terminal: sudo apt install libfreenect0.5. Then start this program again.</source>
        <translation>En una terminal: sudo apt install libfreenect0.5. Luego inicie este programa de nuevo.</translation>
    </message>
    <message>
        <source>The library for USB is not installed.</source>
        <translation>La biblioteca para USB no está instalada.</translation>
    </message>
    <message>
        <source>In a terminal: sudo apt install libusb-1.0-0. Then start this program again.</source>
        <translation>En una terminal: sudo apt install libusb-1.0-0. Luego inicie este programa de nuevo.</translation>
    </message>
    <message>
        <source>The library of its maker is not installed.</source>
        <translation>La biblioteca de su fabricante no está instalada.</translation>
    </message>
    <message>
        <source>The manual, “Which sensors”, tells how it is installed. Then start this program again.</source>
        <translation>El manual, «Qué sensores», dice cómo se instala. Después inicie de nuevo este programa.</translation>
    </message>
    <message>
        <source>The library of its maker cannot be loaded.</source>
        <translation>La biblioteca de su fabricante no se puede cargar.</translation>
    </message>
    <message>
        <source>Install it again; the manual, “Which sensors”, tells how.</source>
        <translation>Instálela de nuevo; el manual, «Qué sensores», dice cómo.</translation>
    </message>
    <message>
        <source>It is not plugged in.</source>
        <translation>No está enchufado.</translation>
    </message>
    <message>
        <source>Check its USB cable and its power supply; it starts by itself when it returns.</source>
        <translation>Revise su cable USB y su fuente de poder; se inicia por sí solo cuando vuelve.</translation>
    </message>
    <message>
        <source>The system does not let you use it.</source>
        <translation>El sistema no le permite usarlo.</translation>
    </message>
    <message>
        <source>Press “Check sensors…” and there “Let me use them…”.</source>
        <translation>Presione «Revisar sensores…» y allí «Permitir usarlos…».</translation>
    </message>
    <message>
        <source>Another program uses it.</source>
        <translation>Otro programa lo usa.</translation>
    </message>
    <message>
        <source>Close that program; “Check sensors…” tells which it is.</source>
        <translation>Cierre ese programa; «Revisar sensores…» dice cuál es.</translation>
    </message>
    <message>
        <source>The system uses it as a webcam (its driver is gspca_kinect) and does not let go of it.</source>
        <translation>El sistema lo usa como cámara web (su controlador es gspca_kinect) y no lo suelta.</translation>
    </message>
    <message>
        <source>In a terminal: sudo modprobe -r gspca_kinect. To keep that driver away for good, write the line “blacklist gspca_kinect” into /etc/modprobe.d/kinect.conf.</source>
        <translation>En una terminal: sudo modprobe -r gspca_kinect. Para que ese controlador no vuelva, escriba la línea “blacklist gspca_kinect” en /etc/modprobe.d/kinect.conf.</translation>
    </message>
    <message>
        <source>Another Kinect has the same serial: they cannot be told apart.</source>
        <translation>Otro Kinect tiene la misma serie: no se pueden distinguir.</translation>
    </message>
    <message>
        <source>Leave only one of them plugged in.</source>
        <translation>Deje enchufado solo uno de ellos.</translation>
    </message>
    <message>
        <source>It does not do what it is told.</source>
        <translation>No hace lo que se le indica.</translation>
    </message>
    <message>
        <source>Unplug its USB cable and its power supply, wait five seconds, and plug both in again.</source>
        <translation>Desenchufe su cable USB y su fuente de poder, espere cinco segundos y enchufe ambos de nuevo.</translation>
    </message>
    <message>
        <source>It does not answer.</source>
        <translation>No responde.</translation>
    </message>
    <message>
        <source>No room is left for its pictures on its USB controller.</source>
        <translation>En su controlador USB no queda lugar para sus imágenes.</translation>
    </message>
    <message>
        <source>Plug it into a socket of another USB controller: each carries one Kinect.</source>
        <translation>Enchúfelo en un puerto de otro controlador USB: cada uno lleva un Kinect.</translation>
    </message>
    <message>
        <source>Its LED, tilt and accelerometer answer only with a firmware of Microsoft&apos;s that cannot be handed on: a bump is seen in the pictures only.</source>
        <translation>Su LED, su inclinación y su acelerómetro responden solo con un firmware de Microsoft que no se puede entregar: un golpe se nota solo en las imágenes.</translation>
    </message>
    <message>
        <source>It is known by the serial of its microphone, since its camera has none.</source>
        <translation>Se lo conoce por la serie de su micrófono, porque su cámara no tiene.</translation>
    </message>
    <message>
        <source>Its near mode is not used.</source>
        <translation>No se usa su modo cercano.</translation>
    </message>
    <message>
        <source>On a USB 2 port it gives fewer and smaller pictures: plug it into a USB 3 port with a USB 3 cable.</source>
        <translation>En un puerto USB 2 da menos imágenes y más pequeñas: conéctelo a un puerto USB 3 con un cable USB 3.</translation>
    </message>
    <message>
        <source>It cannot be told apart from another one that has the same serial: plug in only one of them.</source>
        <translation>No se puede distinguir de otro que tiene la misma serie: enchufe solo uno de ellos.</translation>
    </message>
</context>
<context>
    <name>MadeList</name>
    <message>
        <source>{count} parts</source>
        <translation>{count} partes</translation>
    </message>
    <message>
        <source>cut off, usable up to there</source>
        <translation>interrumpida, se puede usar hasta ahí</translation>
    </message>
    <message>
        <source>Recorded here</source>
        <translation>Grabadas aquí</translation>
    </message>
</context>
<context>
    <name>MeasurePanel</name>
    <message>
        <source>Depth of {sensor}</source>
        <translation>Profundidad de {sensor}</translation>
    </message>
    <message>
        <source>Less</source>
        <translation>Menos</translation>
    </message>
    <message>
        <source>More</source>
        <translation>Más</translation>
    </message>
    <message>
        <source>From the glass to the belt, straight ahead (0: not measured)</source>
        <translation>Del cristal a la cinta, en línea recta (0: sin medir)</translation>
    </message>
    <message>
        <source>Height of the lid over the belt</source>
        <translation>Altura de la tapa sobre la cinta</translation>
    </message>
    <message>
        <source>Diameter of the ball</source>
        <translation>Diámetro de la pelota</translation>
    </message>
    <message>
        <source>How much higher the sensor is than at first</source>
        <translation>Cuánto más alto está el sensor que al principio</translation>
    </message>
</context>
<context>
    <name>ProblemCard</name>
    <message>
        <source>This computer</source>
        <translation>Este computador</translation>
    </message>
</context>
<context>
    <name>ProjectorDesk</name>
    <message>
        <source>The projectors take turns by what was measured.</source>
        <translation>Los proyectores se turnan según lo medido.</translation>
    </message>
</context>
<context>
    <name>Projectors</name>
    <message>
        <source>What it changes</source>
        <translation>Qué cambia</translation>
    </message>
    <message>
        <source>Each alone</source>
        <translation>Cada uno solo</translation>
    </message>
    <message>
        <source>Two at a time</source>
        <translation>De dos en dos</translation>
    </message>
    <message>
        <source>{sensor} beside {other}</source>
        <translation>{sensor} junto a {other}</translation>
    </message>
    <message>
        <source>undisturbed</source>
        <translation>sin estorbos</translation>
    </message>
    <message>
        <source>disturbed</source>
        <translation>estorbado</translation>
    </message>
    <message>
        <source>blinded</source>
        <translation>deslumbrado</translation>
    </message>
    <message>
        <source>steady after {time}; {frames} pictures are left out; {holes} without depth</source>
        <translation>estable después de {time}; se descartan {frames} imágenes; {holes} sin profundidad</translation>
    </message>
    <message>
        <source>Too few pictures came. Check the cable, then measure again.</source>
        <translation>Llegaron muy pocas imágenes. Revise el cable y mida de nuevo.</translation>
    </message>
    <message>
        <source>It sees nothing. Point it at the belt, keep the sun out, then measure again.</source>
        <translation>No ve nada. Apúntelo a la cinta, evite el sol y mida de nuevo.</translation>
    </message>
    <message>
        <source>Something moved meanwhile. Let the belt stand and nobody pass, then measure again.</source>
        <translation>Algo se movió mientras tanto. Deje la cinta quieta, que nadie pase, y mida de nuevo.</translation>
    </message>
    <message>
        <source>Its light did not become steady. Let it warm up for ten minutes, then measure again.</source>
        <translation>Su luz no se estabilizó. Déjelo calentar diez minutos y mida de nuevo.</translation>
    </message>
    <message>
        <source>without depth {alone} → {together}, noise {quiet} → {loud}</source>
        <translation>sin profundidad {alone} → {together}, ruido {quiet} → {loud}</translation>
    </message>
    <message>
        <source>Too few pictures came while both were on.</source>
        <translation>Llegaron muy pocas imágenes mientras ambos estaban encendidos.</translation>
    </message>
    <message>
        <source>Pictures a second, each: {rate_before} → {rate_after}. Belt up to {speed_before} → {speed_after}.</source>
        <translation>Imágenes por segundo, cada uno: {rate_before} → {rate_after}. Cinta hasta {speed_before} → {speed_after}.</translation>
    </message>
</context>
<context>
    <name>ProjectorsDialog</name>
    <message>
        <source>Measure the projectors</source>
        <translation>Medir los proyectores</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>Medir de nuevo</translation>
    </message>
    <message>
        <source>Measure</source>
        <translation>Medir</translation>
    </message>
    <message>
        <source>Switch the projectors on and off</source>
        <translation>Encender y apagar los proyectores</translation>
    </message>
    <message>
        <source>Stop</source>
        <translation>Detener</translation>
    </message>
    <message>
        <source>Stop measuring; nothing is changed</source>
        <translation>Dejar de medir; nada cambia</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Guardar</translation>
    </message>
    <message>
        <source>Take turns by what was measured from now on</source>
        <translation>Turnarse según lo medido de ahora en adelante</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Descartar</translation>
    </message>
    <message>
        <source>Close</source>
        <translation>Cerrar</translation>
    </message>
    <message>
        <source>Go back; nothing is changed</source>
        <translation>Volver; nada cambia</translation>
    </message>
    <message>
        <source>Let the belt stand still, and nobody pass below the sensors.</source>
        <translation>Deje la cinta quieta, y que nadie pase bajo los sensores.</translation>
    </message>
    <message>
        <source>Measuring was stopped; nothing is changed.</source>
        <translation>Se detuvo la medición; nada cambia.</translation>
    </message>
    <message>
        <source>How long does each light take to become steady, and who blinds whom?</source>
        <translation>¿Cuánto tarda cada luz en estabilizarse, y quién deslumbra a quién?</translation>
    </message>
    <message>
        <source>Let the belt stand with a few fruit on it, warm the sensors up for ten minutes, then measure. Each projector is switched on and off, alone and two at a time; it takes about {minutes} min. Until it was measured, careful guesses are used, which cost pictures.</source>
        <translation>Deje la cinta quieta con algunas frutas encima, caliente los sensores diez minutos y mida. Cada proyector se enciende y se apaga, solo y de dos en dos; tarda unos {minutes} min. Mientras no se haya medido, se usan valores prudentes, que cuestan imágenes.</translation>
    </message>
    <message>
        <source>Trying {sensors}</source>
        <translation>Probando {sensors}</translation>
    </message>
    <message>
        <source>Measuring the projectors</source>
        <translation>Midiendo los proyectores</translation>
    </message>
    <message>
        <source>Stopping …</source>
        <translation>Deteniendo …</translation>
    </message>
</context>
<context>
    <name>RecordCard</name>
    <message>
        <source>Recording {name}</source>
        <translation>Grabando {name}</translation>
    </message>
    <message>
        <source>{time} of {length}</source>
        <translation>{time} de {length}</translation>
    </message>
    <message>
        <source>Waiting for the first picture</source>
        <translation>Esperando la primera imagen</translation>
    </message>
    <message>
        <source>No pictures from {sensors}; the others go on.</source>
        <translation>Sin imágenes de {sensors}; los demás siguen.</translation>
    </message>
    <message>
        <source>Stop and keep</source>
        <translation>Parar y guardar</translation>
    </message>
    <message>
        <source>End the recording; what was recorded is kept</source>
        <translation>Terminar la grabación; lo grabado se guarda</translation>
    </message>
</context>
<context>
    <name>RecordDesk</name>
    <message>
        <source>Record…</source>
        <translation>Grabar…</translation>
    </message>
    <message>
        <source>Record what these sensors see</source>
        <translation>Grabar lo que ven estos sensores</translation>
    </message>
</context>
<context>
    <name>RecordDialog</name>
    <message>
        <source>Until I stop it</source>
        <translation>Hasta que la pare</translation>
    </message>
    <message>
        <source>{size} of the disk may be used. The recording will be in {folder}.</source>
        <translation>Se pueden usar {size} del disco. La grabación quedará en {folder}.</translation>
    </message>
    <message>
        <source>Record</source>
        <translation>Grabar</translation>
    </message>
    <message>
        <source>Record the sensors</source>
        <translation>Grabar los sensores</translation>
    </message>
    <message>
        <source>&amp;Name</source>
        <translation>&amp;Nombre</translation>
    </message>
    <message>
        <source>&amp;Length</source>
        <translation>&amp;Duración</translation>
    </message>
</context>
<context>
    <name>ResultView</name>
    <message>
        <source>The depth of {sensor} can be corrected</source>
        <translation>La profundidad de {sensor} puede corregirse</translation>
    </message>
    <message>
        <source>This does not do yet: {sensor}</source>
        <translation>Esto aún no basta: {sensor}</translation>
    </message>
    <message>
        <source>Fitted: {terms}.</source>
        <translation>Ajustado: {terms}.</translation>
    </message>
    <message>
        <source>typed</source>
        <translation>escrito</translation>
    </message>
    <message>
        <source>before</source>
        <translation>antes</translation>
    </message>
    <message>
        <source>after</source>
        <translation>después</translation>
    </message>
    <message>
        <source>Known by</source>
        <translation>Se sabe por</translation>
    </message>
    <message>
        <source>scale</source>
        <translation>escala</translation>
    </message>
    <message>
        <source>offset</source>
        <translation>desplazamiento</translation>
    </message>
    <message>
        <source>depth at the belt</source>
        <translation>profundidad en la cinta</translation>
    </message>
</context>
<context>
    <name>RulesDialog</name>
    <message>
        <source>Let everybody use the sensors</source>
        <translation>Permitir que todos usen los sensores</translation>
    </message>
    <message>
        <source>Let everybody use the sensors?</source>
        <translation>¿Permitir que todos usen los sensores?</translation>
    </message>
    <message>
        <source>These rules go to {path}. From then on everybody who works on this computer may use these sensors. The system asks for the administrator&apos;s password.</source>
        <translation>Estas reglas van a {path}. Desde entonces, todos los que trabajan en este computador pueden usar estos sensores. El sistema pide la clave del administrador.</translation>
    </message>
    <message>
        <source>Install</source>
        <translation>Instalar</translation>
    </message>
    <message>
        <source>Cancel</source>
        <translation>Cancelar</translation>
    </message>
    <message>
        <source>What is done, and the rules</source>
        <translation>Lo que se hace, y las reglas</translation>
    </message>
</context>
<context>
    <name>SensorChanges</name>
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
        <source>Correct its depth…</source>
        <translation>Corregir su profundidad…</translation>
    </message>
    <message>
        <source>Measure with a box, a tape and a ball how far this sensor&apos;s depth is off</source>
        <translation>Medir con una caja, una huincha y una pelota cuánto se equivoca la profundidad de este sensor</translation>
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
        <source>Firmware</source>
        <translation>Firmware</translation>
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
        <source>Whether exposure and white balance, and the light on the belt, stay as they are</source>
        <translation>Si la exposición, el balance de blancos y la luz en la cinta se mantienen</translation>
    </message>
    <message>
        <source>Drift</source>
        <translation>Deriva</translation>
    </message>
    <message>
        <source>Depth</source>
        <translation>Profundidad</translation>
    </message>
    <message>
        <source>Whether its depth still drifts, seen on the bare belt</source>
        <translation>Si su profundidad aún varía, visto en la cinta vacía</translation>
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
        <source>Measure the projectors…</source>
        <translation>Medir los proyectores…</translation>
    </message>
    <message>
        <source>How long each takes to become steady, and who blinds whom</source>
        <translation>Cuánto tarda cada uno en estabilizarse, y quién deslumbra a quién</translation>
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
<context>
    <name>WizardActions</name>
    <message>
        <source>Take</source>
        <translation>Tomar</translation>
    </message>
    <message>
        <source>Take pictures of what lies there</source>
        <translation>Tomar imágenes de lo que hay ahí</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Guardar</translation>
    </message>
    <message>
        <source>Correct this sensor&apos;s depth so from now on</source>
        <translation>Corregir así la profundidad de este sensor desde ahora</translation>
    </message>
    <message>
        <source>Measure again</source>
        <translation>Medir de nuevo</translation>
    </message>
    <message>
        <source>Begin again with the bare belt</source>
        <translation>Empezar de nuevo con la cinta vacía</translation>
    </message>
    <message>
        <source>Another box</source>
        <translation>Otra caja</translation>
    </message>
    <message>
        <source>Take a box of another height as well</source>
        <translation>Tomar también una caja de otra altura</translation>
    </message>
    <message>
        <source>Another height</source>
        <translation>Otra altura</translation>
    </message>
    <message>
        <source>Take the belt from one more height as well</source>
        <translation>Tomar la cinta también desde otra altura más</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Deshacer</translation>
    </message>
    <message>
        <source>Undo the last step, and do it again</source>
        <translation>Deshacer el último paso, y hacerlo de nuevo</translation>
    </message>
    <message>
        <source>Without it</source>
        <translation>Sin ella</translation>
    </message>
    <message>
        <source>Go on without it</source>
        <translation>Continuar sin ella</translation>
    </message>
    <message>
        <source>Take correction away</source>
        <translation>Quitar la corrección</translation>
    </message>
    <message>
        <source>Use this sensor&apos;s depth as the device gives it</source>
        <translation>Usar la profundidad de este sensor tal como la da el aparato</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Volver</translation>
    </message>
    <message>
        <source>Back to the sensors; nothing is kept</source>
        <translation>Volver a los sensores; no se guarda nada</translation>
    </message>
</context>
</TS>
