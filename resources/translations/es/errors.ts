<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="es">
<context>
    <name>Errors</name>
    <message>
        <source>{what} The place: {where}.</source>
        <translation>{what} El lugar: {where}.</translation>
    </message>
    <message>
        <source>{file} is not a whole backup.</source>
        <translation>{file} no es un respaldo completo.</translation>
    </message>
    <message>
        <source>Choose another backup; nothing was changed.</source>
        <translation>Elija otro respaldo; no se cambió nada.</translation>
    </message>
    <message>
        <source>{file} cannot be used: something in it is wrong.</source>
        <translation>{file} no se puede usar: algo en él está mal.</translation>
    </message>
    <message>
        <source>Do that step again, or take a file that was good.</source>
        <translation>Repita ese paso, o use un archivo que estuviera bueno.</translation>
    </message>
    <message>
        <source>{file} cannot be used as labels.</source>
        <translation>{file} no se puede usar como etiquetas.</translation>
    </message>
    <message>
        <source>Save it as this program exports it: sensor, time, place and kind in each row.</source>
        <translation>Guárdelo como lo exporta este programa: sensor, hora, lugar y tipo en cada fila.</translation>
    </message>
    <message>
        <source>{file} cannot be used as poses.</source>
        <translation>{file} no se puede usar como poses.</translation>
    </message>
    <message>
        <source>Each row needs a time, a sensor, a place and a unit quaternion.</source>
        <translation>Cada fila necesita una hora, un sensor, un lugar y un cuaternión unitario.</translation>
    </message>
    <message>
        <source>The calibration in {file} cannot be used.</source>
        <translation>La calibración de {file} no se puede usar.</translation>
    </message>
    <message>
        <source>Calibrate again, or take the last good one.</source>
        <translation>Calibre de nuevo, o use la última buena.</translation>
    </message>
    <message>
        <source>{path} cannot be read.</source>
        <translation>No se puede leer {path}.</translation>
    </message>
    <message>
        <source>{path} cannot be written.</source>
        <translation>No se puede escribir {path}.</translation>
    </message>
    <message>
        <source>{file} is there: a recording that was cut off, or one that is being made right now.</source>
        <translation>{file} ya está: una grabación que se cortó, o una que se está haciendo ahora.</translation>
    </message>
    <message>
        <source>Let it end, or save what is in it first, or delete it.</source>
        <translation>Deje que termine, o rescate primero lo que tiene, o bórrela.</translation>
    </message>
    <message>
        <source>The recording cannot be finished: the disk is full, or gone.</source>
        <translation>No se puede terminar la grabación: el disco está lleno, o ya no está.</translation>
    </message>
    <message>
        <source>What was recorded is in {file}: find it among the recordings of step 1.</source>
        <translation>Lo grabado está en {file}: búsquelo en Grabación, paso 1.</translation>
    </message>
    <message>
        <source>{file} is there already, where a part of this recording would go.</source>
        <translation>{file} ya está donde iría una parte de esta grabación.</translation>
    </message>
    <message>
        <source>Give the recording another name, or move that file away.</source>
        <translation>Dé otro nombre a la grabación, o mueva ese archivo.</translation>
    </message>
    <message>
        <source>The recording {file} has too many parts.</source>
        <translation>La grabación {file} tiene demasiadas partes.</translation>
    </message>
    <message>
        <source>Let its parts be larger.</source>
        <translation>Haga las partes más grandes.</translation>
    </message>
    <message>
        <source>Check that it is still there and may be read.</source>
        <translation>Revise que siga ahí y que se pueda leer.</translation>
    </message>
    <message>
        <source>The backup could not be put in place.</source>
        <translation>No se pudo poner el respaldo en su lugar.</translation>
    </message>
    <message>
        <source>Check that the folder {file} may be written to, and start the program again: the restore goes on.</source>
        <translation>Revise que se pueda escribir en la carpeta {file} e inicie el programa de nuevo: la restauración sigue.</translation>
    </message>
    <message>
        <source>Check that its folder exists, may be written to, and has room.</source>
        <translation>Revise que su carpeta exista, que se pueda escribir en ella y que tenga espacio.</translation>
    </message>
    <message>
        <source>The disk is full; {file} cannot take more.</source>
        <translation>El disco está lleno; {file} no puede recibir más.</translation>
    </message>
    <message>
        <source>Make room on the disk, or keep pictures for fewer days. Nothing that was counted is lost.</source>
        <translation>Haga espacio en el disco, o guarde las fotos menos días. Nada de lo contado se perdió.</translation>
    </message>
    <message>
        <source>{file} is too large to be a file of this program.</source>
        <translation>{file} es demasiado grande para ser un archivo de este programa.</translation>
    </message>
    <message>
        <source>Choose the right file.</source>
        <translation>Elija el archivo correcto.</translation>
    </message>
    <message>
        <source>{file} is not a file of this program.</source>
        <translation>{file} no es un archivo de este programa.</translation>
    </message>
    <message>
        <source>Choose a file that this program wrote.</source>
        <translation>Elija un archivo escrito por este programa.</translation>
    </message>
    <message>
        <source>{file} is not a text file.</source>
        <translation>{file} no es un archivo de texto.</translation>
    </message>
    <message>
        <source>Save it as UTF-8, or choose the right file.</source>
        <translation>Guárdelo como UTF-8, o elija el archivo correcto.</translation>
    </message>
    <message>
        <source>What was seen of a fruit cannot be used.</source>
        <translation>Lo que se vio de una fruta no se puede usar.</translation>
    </message>
    <message>
        <source>Leave this fruit out.</source>
        <translation>Deje fuera esa fruta.</translation>
    </message>
    <message>
        <source>The names of the kinds cannot be used.</source>
        <translation>Los nombres de los tipos no se pueden usar.</translation>
    </message>
    <message>
        <source>Rename the kinds.</source>
        <translation>Cambie los nombres de los tipos.</translation>
    </message>
    <message>
        <source>The model cannot be used.</source>
        <translation>El modelo no se puede usar.</translation>
    </message>
    <message>
        <source>Train again, or roll back to the model before; no lot starts with it.</source>
        <translation>Entrene de nuevo, o vuelva al modelo anterior; con este no empieza ningún lote.</translation>
    </message>
    <message>
        <source>A model of this name is kept already.</source>
        <translation>Ya hay un modelo guardado con ese nombre.</translation>
    </message>
    <message>
        <source>Give it another name.</source>
        <translation>Dele otro nombre.</translation>
    </message>
    <message>
        <source>No row of {file} points at a fruit that was seen.</source>
        <translation>Ninguna fila de {file} señala una fruta que se haya visto.</translation>
    </message>
    <message>
        <source>Check that the file belongs to this recording.</source>
        <translation>Revise que el archivo sea de esta grabación.</translation>
    </message>
    <message>
        <source>No fruit has a kind yet.</source>
        <translation>Ninguna fruta tiene tipo todavía.</translation>
    </message>
    <message>
        <source>Name some fruit first.</source>
        <translation>Nombre algunas frutas primero.</translation>
    </message>
    <message>
        <source>No model was in use before this one.</source>
        <translation>No se usó ningún modelo antes de este.</translation>
    </message>
    <message>
        <source>There is nothing to go back to.</source>
        <translation>No hay nada a lo que volver.</translation>
    </message>
    <message>
        <source>That model is not there any more.</source>
        <translation>Ese modelo ya no está.</translation>
    </message>
    <message>
        <source>Choose another, or train again.</source>
        <translation>Elija otro, o entrene de nuevo.</translation>
    </message>
    <message>
        <source>The model was trained by another version of this program.</source>
        <translation>El modelo fue entrenado por otra versión de este programa.</translation>
    </message>
    <message>
        <source>Train again; no lot starts with it.</source>
        <translation>Entrene de nuevo; con este no empieza ningún lote.</translation>
    </message>
    <message>
        <source>There is no simulated rig of this kind.</source>
        <translation>No hay un equipo simulado de ese tipo.</translation>
    </message>
    <message>
        <source>Choose one of the list.</source>
        <translation>Elija uno de la lista.</translation>
    </message>
    <message>
        <source>What the line was connected to cannot be read.</source>
        <translation>No se puede leer a qué estaba conectada la línea.</translation>
    </message>
    <message>
        <source>Connect again in step 1.</source>
        <translation>Conecte de nuevo en el paso 1.</translation>
    </message>
    <message>
        <source>A picture has a time that cannot be.</source>
        <translation>Una imagen tiene una hora imposible.</translation>
    </message>
    <message>
        <source>Check the sensor&apos;s clock.</source>
        <translation>Revise el reloj del sensor.</translation>
    </message>
    <message>
        <source>The names of the topics cannot be read.</source>
        <translation>No se pueden leer los nombres de los temas.</translation>
    </message>
    <message>
        <source>Check how they are written.</source>
        <translation>Revise cómo están escritos.</translation>
    </message>
    <message>
        <source>A colour picture cannot be packed.</source>
        <translation>No se puede comprimir una imagen de color.</translation>
    </message>
    <message>
        <source>Look at the sensor.</source>
        <translation>Revise el sensor.</translation>
    </message>
    <message>
        <source>{file} is empty.</source>
        <translation>{file} está vacío.</translation>
    </message>
    <message>
        <source>Record again, or choose another file.</source>
        <translation>Grabe de nuevo, o elija otro archivo.</translation>
    </message>
    <message>
        <source>The recording of {sensor} is over.</source>
        <translation>La grabación de {sensor} terminó.</translation>
    </message>
    <message>
        <source>Start it again to see it anew.</source>
        <translation>Iníciela otra vez para verla de nuevo.</translation>
    </message>
    <message>
        <source>{sensor} gives pictures of another size than when it was calibrated.</source>
        <translation>{sensor} da imágenes de otro tamaño que cuando se calibró.</translation>
    </message>
    <message>
        <source>Calibrate again.</source>
        <translation>Calibre de nuevo.</translation>
    </message>
    <message>
        <source>A helping process has ended.</source>
        <translation>Un proceso auxiliar terminó.</translation>
    </message>
    <message>
        <source>The line goes on without it.</source>
        <translation>La línea sigue sin él.</translation>
    </message>
    <message>
        <source>A part of the line&apos;s work failed.</source>
        <translation>Falló una parte del trabajo de la línea.</translation>
    </message>
    <message>
        <source>The line goes on; if this comes often, calibrate again. The log says more.</source>
        <translation>La línea sigue; si pasa a menudo, calibre de nuevo. El registro dice más.</translation>
    </message>
    <message>
        <source>The line could not be started.</source>
        <translation>No se pudo iniciar la línea.</translation>
    </message>
    <message>
        <source>Close other programs and try again. The log says more.</source>
        <translation>Cierre otros programas e inténtelo de nuevo. El registro dice más.</translation>
    </message>
    <message>
        <source>{file} is a video of an Azure Kinect&apos;s recorder, which cannot be read here.</source>
        <translation>{file} es un vídeo de la grabadora de Azure Kinect, que aquí no se puede leer.</translation>
    </message>
    <message>
        <source>Play it through the Azure Kinect&apos;s ROS driver and record that as .mcap or .bag.</source>
        <translation>Reprodúzcalo con el controlador ROS de Azure Kinect y grábelo como .mcap o .bag.</translation>
    </message>
    <message>
        <source>The pictures of one sensor differ in size.</source>
        <translation>Las imágenes de un sensor tienen tamaños distintos.</translation>
    </message>
    <message>
        <source>Record all of them at one resolution.</source>
        <translation>Grábelas todas con una sola resolución.</translation>
    </message>
    <message>
        <source>Not one picture of {file} can be read.</source>
        <translation>No se puede leer ni una imagen de {file}.</translation>
    </message>
    <message>
        <source>A sensor gave no pictures.</source>
        <translation>Un sensor no dio imágenes.</translation>
    </message>
    <message>
        <source>Check that all sensors run, and try again.</source>
        <translation>Revise que todos los sensores funcionen e intente de nuevo.</translation>
    </message>
    <message>
        <source>Nothing can be saved from {file}.</source>
        <translation>No se puede rescatar nada de {file}.</translation>
    </message>
    <message>
        <source>Record again.</source>
        <translation>Grabe de nuevo.</translation>
    </message>
    <message>
        <source>The simulated rig cannot be started.</source>
        <translation>No se puede iniciar el equipo simulado.</translation>
    </message>
    <message>
        <source>Close other programs and try again.</source>
        <translation>Cierre otros programas e intente de nuevo.</translation>
    </message>
    <message>
        <source>{file} holds no sensor that this program knows.</source>
        <translation>{file} no tiene ningún sensor que este programa conozca.</translation>
    </message>
    <message>
        <source>Choose another recording.</source>
        <translation>Elija otra grabación.</translation>
    </message>
    <message>
        <source>None of the sensors is one of those that were calibrated.</source>
        <translation>Ninguno de los sensores es de los que se calibraron.</translation>
    </message>
    <message>
        <source>Connect the sensors that were calibrated, or calibrate again.</source>
        <translation>Conecte los sensores que se calibraron, o calibre de nuevo.</translation>
    </message>
    <message>
        <source>The reference sensor is not there.</source>
        <translation>El sensor de referencia no está.</translation>
    </message>
    <message>
        <source>Choose another reference in step 1.</source>
        <translation>Elija otra referencia en el paso 1.</translation>
    </message>
    <message>
        <source>No two of these sensors have to take turns.</source>
        <translation>Ningún par de estos sensores tiene que turnarse.</translation>
    </message>
    <message>
        <source>There is nothing to measure; go on.</source>
        <translation>No hay nada que medir; siga adelante.</translation>
    </message>
    <message>
        <source>Fewer than two poses have a picture in the recording.</source>
        <translation>Menos de dos poses tienen una imagen en la grabación.</translation>
    </message>
    <message>
        <source>Check that poses and recording belong together.</source>
        <translation>Revise que las poses y la grabación vayan juntas.</translation>
    </message>
    <message>
        <source>{file} is a folder.</source>
        <translation>{file} es una carpeta.</translation>
    </message>
    <message>
        <source>Choose a recording (.mcap or .bag).</source>
        <translation>Elija una grabación (.mcap o .bag).</translation>
    </message>
    <message>
        <source>{file} is not a recording that can be read.</source>
        <translation>{file} no es una grabación que se pueda leer.</translation>
    </message>
    <message>
        <source>{file} needs no recovery.</source>
        <translation>{file} no necesita rescate.</translation>
    </message>
    <message>
        <source>Use it as it is; it is read as far as it is sound.</source>
        <translation>Úselo como está; se lee hasta donde esté sano.</translation>
    </message>
    <message>
        <source>{sensor} gave no picture in its turns.</source>
        <translation>{sensor} no dio ninguna imagen en sus turnos.</translation>
    </message>
    <message>
        <source>Check its cable and power, or leave it out, and measure again.</source>
        <translation>Revise su cable y su fuente, o déjelo fuera, y mida de nuevo.</translation>
    </message>
    <message>
        <source>{file} is the file that is to be recovered.</source>
        <translation>{file} es el archivo que se va a rescatar.</translation>
    </message>
    <message>
        <source>Choose another file to write to.</source>
        <translation>Elija otro archivo de destino.</translation>
    </message>
    <message>
        <source>{sensor} failed.</source>
        <translation>{sensor} falló.</translation>
    </message>
    <message>
        <source>It is opened again by itself; if it stays away, unplug it and plug it in again.</source>
        <translation>Se abre de nuevo solo; si no vuelve, desenchúfelo y enchúfelo otra vez.</translation>
    </message>
    <message>
        <source>A sensor is not open.</source>
        <translation>Un sensor no está abierto.</translation>
    </message>
    <message>
        <source>A sensor is not running.</source>
        <translation>Un sensor no está en marcha.</translation>
    </message>
    <message>
        <source>{file} is a ROS 2 recording in an SQLite file, which cannot be read here.</source>
        <translation>{file} es una grabación de ROS 2 en un archivo SQLite, que aquí no se puede leer.</translation>
    </message>
    <message>
        <source>Turn it into MCAP with rosbags-convert, or choose another recording.</source>
        <translation>Conviértala a MCAP con rosbags-convert, o elija otra grabación.</translation>
    </message>
    <message>
        <source>USB cannot be used on this computer.</source>
        <translation>En este equipo no se puede usar USB.</translation>
    </message>
    <message>
        <source>Check that it is switched on.</source>
        <translation>Revise que esté activado.</translation>
    </message>
    <message>
        <source>{sensor} gives no pictures.</source>
        <translation>{sensor} no da imágenes.</translation>
    </message>
    <message>
        <source>Check its cable and power; it is opened again by itself when it returns.</source>
        <translation>Revise su cable y su corriente; se abre de nuevo solo cuando vuelve.</translation>
    </message>
    <message>
        <source>The simulated rig has ended.</source>
        <translation>El equipo simulado terminó.</translation>
    </message>
    <message>
        <source>It is started again by itself.</source>
        <translation>Se inicia de nuevo solo.</translation>
    </message>
    <message>
        <source>{file} holds more sensors than can be read together.</source>
        <translation>{file} tiene más sensores de los que se pueden leer juntos.</translation>
    </message>
    <message>
        <source>Choose a recording with fewer.</source>
        <translation>Elija una grabación con menos.</translation>
    </message>
    <message>
        <source>Something went wrong in “{doing}” that this program did not foresee.</source>
        <translation>Algo falló en «{doing}» que este programa no previó.</translation>
    </message>
    <message>
        <source>Nothing that was saved is lost. Try again; if it happens again, send the log file (Help, Show log).</source>
        <translation>No se perdió nada de lo guardado. Intente de nuevo; si se repite, envíe el archivo de registro (Ayuda, Ver registro).</translation>
    </message>
    <message>
        <source>A sensor that is wanted is not there: {sensor}.</source>
        <translation>Falta un sensor que se pide: {sensor}.</translation>
    </message>
    <message>
        <source>Leave it out, or calibrate again with it.</source>
        <translation>Déjelo fuera, o calibre de nuevo con él.</translation>
    </message>
    <message>
        <source>A sensor in the recording {file} cannot be used.</source>
        <translation>Un sensor de la grabación {file} no se puede usar.</translation>
    </message>
    <message>
        <source>Record it again with colour, depth, and their calibration. The log says what is missing.</source>
        <translation>Grábelo de nuevo con color, profundidad y su calibración. El registro dice qué falta.</translation>
    </message>
    <message>
        <source>This system has no udev.</source>
        <translation>Este sistema no tiene udev.</translation>
    </message>
    <message>
        <source>The rules are of use on Linux with udev only; nothing is to be done.</source>
        <translation>Las reglas solo sirven en Linux con udev; no hay nada que hacer.</translation>
    </message>
    <message>
        <source>Only the administrator of this computer may do that.</source>
        <translation>Solo el administrador de este equipo puede hacerlo.</translation>
    </message>
    <message>
        <source>Ask whoever looks after this computer to do it.</source>
        <translation>Pídaselo a quien cuida de este equipo.</translation>
    </message>
    <message>
        <source>The rules for the sensors were not installed.</source>
        <translation>No se instalaron las reglas para los sensores.</translation>
    </message>
    <message>
        <source>Try again with the administrator&apos;s password, or ask whoever looks after this computer.</source>
        <translation>Intente de nuevo con la clave del administrador, o pídaselo a quien cuida de este equipo.</translation>
    </message>
    <message>
        <source>This cannot be the name of a kind.</source>
        <translation>Ese no puede ser el nombre de un tipo.</translation>
    </message>
    <message>
        <source>Use 1 to {most} printable letters.</source>
        <translation>Use de 1 a {most} letras imprimibles.</translation>
    </message>
    <message>
        <source>{value} is no measure.</source>
        <translation>{value} no es una medida.</translation>
    </message>
    <message>
        <source>Type a number above zero.</source>
        <translation>Escriba un número mayor que cero.</translation>
    </message>
    <message>
        <source>Another window has this line open.</source>
        <translation>Otra ventana tiene abierta esta línea.</translation>
    </message>
    <message>
        <source>Go on in that window, or close it and try again.</source>
        <translation>Siga en esa ventana, o ciérrela y vuelva a intentarlo.</translation>
    </message>
    <message>
        <source>Lot {lot} is ended.</source>
        <translation>El lote {lot} ya terminó.</translation>
    </message>
    <message>
        <source>Start another lot.</source>
        <translation>Inicie otro lote.</translation>
    </message>
    <message>
        <source>Lot {lot} is still open.</source>
        <translation>El lote {lot} sigue abierto.</translation>
    </message>
    <message>
        <source>End it first.</source>
        <translation>Termínelo primero.</translation>
    </message>
    <message>
        <source>The lot has no name.</source>
        <translation>El lote no tiene nombre.</translation>
    </message>
    <message>
        <source>Give it a name or a number.</source>
        <translation>Dele un nombre o un número.</translation>
    </message>
    <message>
        <source>That fruit is not there any more.</source>
        <translation>Esa fruta ya no está.</translation>
    </message>
    <message>
        <source>Choose another of the list.</source>
        <translation>Elija otro de la lista.</translation>
    </message>
    <message>
        <source>That lot is not there any more.</source>
        <translation>Ese lote ya no está.</translation>
    </message>
    <message>
        <source>Some numbers of a fruit in the records are damaged.</source>
        <translation>Algunos números de una fruta en los registros están dañados.</translation>
    </message>
    <message>
        <source>The other fruit can be used; restore the last good backup to have this one too.</source>
        <translation>Las demás frutas se pueden usar; restaure el último respaldo bueno para tener también esta.</translation>
    </message>
    <message>
        <source>A backup is put in place at the next start; what is counted until then would go aside.</source>
        <translation>En el próximo inicio se pone un respaldo en su lugar; lo que se cuente hasta entonces quedaría aparte.</translation>
    </message>
    <message>
        <source>Close the window and start again, or choose “Do not restore after all” at step 7.</source>
        <translation>Cierre la ventana y vuelva a iniciar, o elija «No restaurar» en el paso 7.</translation>
    </message>
    <message>
        <source>{file} is damaged.</source>
        <translation>{file} está dañado.</translation>
    </message>
    <message>
        <source>A good backup, where there is one, can be restored; what is there now is kept aside.</source>
        <translation>Se puede restaurar un respaldo bueno, si lo hay; lo que hay ahora se guarda aparte.</translation>
    </message>
    <message>
        <source>{file} could not be read or written.</source>
        <translation>No se pudo leer o escribir {file}.</translation>
    </message>
    <message>
        <source>Check the disk; if this comes back, restore the last good backup.</source>
        <translation>Revise el disco; si se repite, restaure el último respaldo bueno.</translation>
    </message>
    <message>
        <source>Another program holds {file}.</source>
        <translation>Otro programa tiene ocupado {file}.</translation>
    </message>
    <message>
        <source>Close other windows that have this line open, and try again.</source>
        <translation>Cierre otras ventanas que tengan abierta esta línea e intente de nuevo.</translation>
    </message>
    <message>
        <source>{file} was written by a newer version of this program.</source>
        <translation>{file} fue escrito por una versión más nueva de este programa.</translation>
    </message>
    <message>
        <source>Start the newer version, or restore a backup that this version made.</source>
        <translation>Inicie la versión más nueva, o restaure un respaldo hecho por esta.</translation>
    </message>
    <message>
        <source>{file} cannot be opened or written.</source>
        <translation>{file} no se puede abrir o escribir.</translation>
    </message>
    <message>
        <source>Check that its folder exists and may be written to.</source>
        <translation>Revise que su carpeta exista y que se pueda escribir en ella.</translation>
    </message>
    <message>
        <source>A fruit of {source} is kept already.</source>
        <translation>Una fruta de {source} ya está guardada.</translation>
    </message>
    <message>
        <source>Remove it first, or watch something else.</source>
        <translation>Quítela primero, u observe otra cosa.</translation>
    </message>
</context>
</TS>
