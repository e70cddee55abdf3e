<?xml version="1.0" encoding="utf-8"?>
<!DOCTYPE TS>
<TS version="2.1" language="es">
<context>
    <name>Calibrate</name>
    <message>
        <source>Capturing the still scene: keep hands away</source>
        <translation>Captando la escena quieta: no acerque las manos</translation>
    </message>
    <message>
        <source>Finding the belt of {sensor}</source>
        <translation>Buscando la cinta de {sensor}</translation>
    </message>
    <message>
        <source>Matching {one} to {other}</source>
        <translation>Calzando {one} con {other}</translation>
    </message>
    <message>
        <source>Placing the sensors</source>
        <translation>Ubicando los sensores</translation>
    </message>
    <message>
        <source>Drawing what the sensors see</source>
        <translation>Dibujando lo que ven los sensores</translation>
    </message>
    <message>
        <source>{sensor} sees two surfaces that could be the belt. Check its grid on the screen “Belt”.</source>
        <translation>{sensor} ve dos superficies que podrían ser la cinta. Revise su cuadrícula en la pantalla «Cinta».</translation>
    </message>
    <message>
        <source>{one} sees distances {share} % longer than {other}: the depth of one of them is off. Correct it on the screen “Connect”.</source>
        <translation>{one} ve distancias un {share} % más largas que {other}: la profundidad de uno de los dos no es correcta. Corríjala en la pantalla «Conectar».</translation>
    </message>
    <message>
        <source>{sensor} is placed to {place} mm and {angle}° only; more fruit in the common view would make it better.</source>
        <translation>{sensor} quedó ubicado solo con {place} mm y {angle}°; más fruta en la vista común lo mejoraría.</translation>
    </message>
    <message>
        <source>What {one} and {other} have in common contradicts the other pairs and was left out.</source>
        <translation>Lo que {one} y {other} tienen en común contradice a los demás pares y se dejó fuera.</translation>
    </message>
    <message>
        <source>Looking at the belt …</source>
        <translation>Mirando la cinta …</translation>
    </message>
    <message>
        <source>no belt in view</source>
        <translation>no ve la cinta</translation>
    </message>
    <message>
        <source>something moves</source>
        <translation>algo se mueve</translation>
    </message>
    <message>
        <source>{things} pieces</source>
        <translation>{things} piezas</translation>
    </message>
    <message>
        <source>No belt is in view of {sensors}.</source>
        <translation>No se ve ninguna cinta desde {sensors}.</translation>
    </message>
    <message>
        <source>Something moves. Stop the belt and keep hands away.</source>
        <translation>Algo se mueve. Detenga la cinta y no acerque las manos.</translation>
    </message>
    <message>
        <source>The belt is in view. Press Calibrate.</source>
        <translation>La cinta está a la vista. Presione Calibrar.</translation>
    </message>
    <message>
        <source>That is plenty. Press Calibrate.</source>
        <translation>Es más que suficiente. Presione Calibrar.</translation>
    </message>
    <message>
        <source>That may do. More fruit where the views overlap would be better.</source>
        <translation>Puede bastar. Sería mejor con más fruta donde las vistas se traslapan.</translation>
    </message>
    <message>
        <source>That is little. Put more fruit where the views overlap.</source>
        <translation>Es poco. Ponga más fruta donde las vistas se traslapan.</translation>
    </message>
    <message>
        <source>{sensor} sees no flat surface that could be the belt.</source>
        <translation>{sensor} no ve ninguna superficie plana que pueda ser la cinta.</translation>
    </message>
    <message>
        <source>What stands on a belt can only be told from it where the belt itself is seen.</source>
        <translation>Lo que hay sobre una cinta solo se distingue de ella donde se ve la cinta misma.</translation>
    </message>
    <message>
        <source>Turn the sensor so that the belt fills most of its picture, and nothing hides it.</source>
        <translation>Gire el sensor para que la cinta llene casi toda su imagen y nada la tape.</translation>
    </message>
    <message>
        <source>What {sensor} has in common with the others holds it too loosely.</source>
        <translation>Lo que {sensor} tiene en común con los demás no lo fija lo suficiente.</translation>
    </message>
    <message>
        <source>{sensors}: things in common {things}, belt in common {overlap}.</source>
        <translation>{sensors}: cosas en común {things}, cinta en común {overlap}.</translation>
    </message>
    <message>
        <source>{sensors} have next to nothing in common.</source>
        <translation>{sensors} no tienen casi nada en común.</translation>
    </message>
    <message>
        <source>{sensors}: too little stands on the belt.</source>
        <translation>{sensors}: hay muy poco sobre la cinta.</translation>
    </message>
    <message>
        <source>{sensors}: what they see fits together in more than one way.</source>
        <translation>{sensors}: lo que ven calza de más de una manera.</translation>
    </message>
    <message>
        <source>{sensors}: something moved while the scene was captured.</source>
        <translation>{sensors}: algo se movió mientras se captaba la escena.</translation>
    </message>
    <message>
        <source>Nothing links all of these sensors: {sensors}.</source>
        <translation>Nada une a todos estos sensores: {sensors}.</translation>
    </message>
    <message>
        <source>Two sensors find each other only by what both of them see.</source>
        <translation>Dos sensores se encuentran solo por lo que ambos ven.</translation>
    </message>
    <message>
        <source>A bare belt looks the same wherever it is seen from; fruit tell where a sensor stands.</source>
        <translation>Una cinta vacía se ve igual desde cualquier lado; la fruta dice dónde está un sensor.</translation>
    </message>
    <message>
        <source>A pattern that repeats itself fits as well one step farther.</source>
        <translation>Un patrón que se repite calza igual de bien un paso más allá.</translation>
    </message>
    <message>
        <source>What has moved between two pictures puts the sensors in a wrong place.</source>
        <translation>Lo que se movió entre dos imágenes deja los sensores mal ubicados.</translation>
    </message>
    <message>
        <source>Every sensor must be linked to the reference, through others or not.</source>
        <translation>Cada sensor debe quedar unido a la referencia, directamente o a través de otros.</translation>
    </message>
    <message>
        <source>Turn the sensors so that at least a third of what they see is common, with five or more pieces in it.</source>
        <translation>Gire los sensores para que al menos un tercio de lo que ven sea común, con cinco o más piezas ahí.</translation>
    </message>
    <message>
        <source>Put ten or more pieces of fruit, spread over all of the belt that the sensors see.</source>
        <translation>Ponga diez o más piezas de fruta, repartidas por toda la cinta que ven los sensores.</translation>
    </message>
    <message>
        <source>Spread the fruit unevenly, of different kinds and sizes, or add one odd object.</source>
        <translation>Reparta la fruta en forma desigual, de distintos tipos y tamaños, o agregue un objeto distinto.</translation>
    </message>
    <message>
        <source>Stop the belt, keep hands away, and try again.</source>
        <translation>Detenga la cinta, no acerque las manos e intente de nuevo.</translation>
    </message>
    <message>
        <source>Add or turn a sensor so that its view links the groups, with fruit in the common part.</source>
        <translation>Agregue o gire un sensor para que su vista una los grupos, con fruta en la parte común.</translation>
    </message>
    <message>
        <source>The sensors could not be placed.</source>
        <translation>No se pudo ubicar los sensores.</translation>
    </message>
    <message>
        <source>Belt flat within</source>
        <translation>Cinta plana dentro de</translation>
    </message>
    <message>
        <source>One sensor, and the belt that it sees.</source>
        <translation>Un sensor, y la cinta que ve.</translation>
    </message>
    <message>
        <source>Placed within (95 %)</source>
        <translation>Ubicados dentro de (95 %)</translation>
    </message>
    <message>
        <source>Turned within (95 %)</source>
        <translation>Girados dentro de (95 %)</translation>
    </message>
    <message>
        <source>Checked on pieces held out</source>
        <translation>Comprobado con piezas aparte</translation>
    </message>
    <message>
        <source>The sensors agree; fruit are measured as if by one.</source>
        <translation>Los sensores coinciden; la fruta se mide como con uno solo.</translation>
    </message>
    <message>
        <source>It works; more fruit in the common view would make it better.</source>
        <translation>Funciona; con más fruta en la vista común sería mejor.</translation>
    </message>
    <message>
        <source>Good</source>
        <translation>Buena</translation>
    </message>
    <message>
        <source>Usable</source>
        <translation>Utilizable</translation>
    </message>
    <message>
        <source>Redo</source>
        <translation>Rehacer</translation>
    </message>
    <message>
        <source>in doubt</source>
        <translation>en duda</translation>
    </message>
    <message>
        <source>reference</source>
        <translation>referencia</translation>
    </message>
</context>
<context>
    <name>CalibratePage</name>
    <message>
        <source>Calibrate</source>
        <translation>Calibrar</translation>
    </message>
    <message>
        <source>Let the sensors find each other</source>
        <translation>Dejar que los sensores se encuentren</translation>
    </message>
    <message>
        <source>Keep</source>
        <translation>Guardar</translation>
    </message>
    <message>
        <source>Work with this calibration from now on</source>
        <translation>Trabajar con esta calibración desde ahora</translation>
    </message>
    <message>
        <source>Discard</source>
        <translation>Descartar</translation>
    </message>
    <message>
        <source>Stay with what was before</source>
        <translation>Quedarse con lo que había antes</translation>
    </message>
    <message>
        <source>Calibrate again</source>
        <translation>Calibrar de nuevo</translation>
    </message>
    <message>
        <source>Begin anew; the calibration in use stays until another is kept</source>
        <translation>Empezar de nuevo; la calibración en uso se mantiene hasta que se guarde otra</translation>
    </message>
    <message>
        <source>Back</source>
        <translation>Volver</translation>
    </message>
    <message>
        <source>No sensors run</source>
        <translation>No funciona ningún sensor</translation>
    </message>
    <message>
        <source>Connect them first; then they find each other and the belt here, from fruit that lie on it.</source>
        <translation>Conéctelos primero; después se encuentran aquí entre sí y con la cinta, a partir de la fruta que hay sobre ella.</translation>
    </message>
    <message>
        <source>Look at the cloud: where views overlap, nothing should appear twice. Then keep it.</source>
        <translation>Mire la nube: donde las vistas se traslapan nada debe verse doble. Luego guárdela.</translation>
    </message>
    <message>
        <source>Change what the pictures show, then calibrate once more.</source>
        <translation>Cambie lo que muestran los dibujos y calibre otra vez.</translation>
    </message>
    <message>
        <source>The sensors are calibrated.</source>
        <translation>Los sensores están calibrados.</translation>
    </message>
    <message>
        <source>Connect the sensors first.</source>
        <translation>Conecte primero los sensores.</translation>
    </message>
    <message>
        <source>The line runs. Its sensors can be calibrated when the lot has ended.</source>
        <translation>La línea está funcionando. Sus sensores se pueden calibrar cuando termine el lote.</translation>
    </message>
    <message>
        <source>Not all sensors give pictures; look after them on the screen “Connect”.</source>
        <translation>No todos los sensores entregan imágenes; revíselos en la pantalla «Conectar».</translation>
    </message>
    <message>
        <source>Put fruit on the belt as in the picture, then press Calibrate. It takes some seconds.</source>
        <translation>Ponga fruta en la cinta como en el dibujo y presione Calibrar. Toma unos segundos.</translation>
    </message>
    <message>
        <source>Calibrating</source>
        <translation>Calibrando</translation>
    </message>
    <message>
        <source>Calibrating was stopped; nothing was changed.</source>
        <translation>Se detuvo la calibración; nada cambió.</translation>
    </message>
    <message>
        <source>Looking at the belt</source>
        <translation>Mirando la cinta</translation>
    </message>
    <message>
        <source>The calibration is kept.</source>
        <translation>La calibración quedó guardada.</translation>
    </message>
    <message>
        <source>Undo</source>
        <translation>Deshacer</translation>
    </message>
</context>
<context>
    <name>CloudView</name>
    <message>
        <source>3D</source>
        <translation>3D</translation>
    </message>
    <message>
        <source>Turn it with the mouse</source>
        <translation>Girarla con el mouse</translation>
    </message>
    <message>
        <source>From above</source>
        <translation>Desde arriba</translation>
    </message>
    <message>
        <source>Look from above</source>
        <translation>Mirar desde arriba</translation>
    </message>
    <message>
        <source>From the side</source>
        <translation>De lado</translation>
    </message>
    <message>
        <source>Look along the belt&apos;s surface</source>
        <translation>Mirar a ras de la cinta</translation>
    </message>
    <message>
        <source>Before</source>
        <translation>Antes</translation>
    </message>
    <message>
        <source>How the sensors were thought to stand before</source>
        <translation>Como se creía antes que estaban los sensores</translation>
    </message>
    <message>
        <source>After</source>
        <translation>Después</translation>
    </message>
    <message>
        <source>How the sensors stand</source>
        <translation>Como están los sensores</translation>
    </message>
    <message>
        <source>All</source>
        <translation>Todos</translation>
    </message>
    <message>
        <source>Show all sensors at once</source>
        <translation>Mostrar todos los sensores a la vez</translation>
    </message>
    <message>
        <source>Fade from sensor to sensor: where they agree, nothing jumps</source>
        <translation>Pasar de un sensor a otro: donde coinciden, nada salta</translation>
    </message>
    <message>
        <source>Fade between the sensors</source>
        <translation>Pasar de un sensor a otro</translation>
    </message>
</context>
<context>
    <name>FlatCloud</name>
    <message>
        <source>{length}; heights drawn 2.5 times as large</source>
        <translation>{length}; alturas dibujadas 2,5 veces más grandes</translation>
    </message>
</context>
<context>
    <name>PreparePanel</name>
    <message>
        <source>Put fruit on the belt, and stop it</source>
        <translation>Ponga fruta en la cinta y deténgala</translation>
    </message>
    <message>
        <source>What the sensors have in common now</source>
        <translation>Lo que los sensores tienen en común ahora</translation>
    </message>
    <message>
        <source>Counted are the pieces that two sensors see alike and in the same arrangement: {least} are needed, {enough} are good.</source>
        <translation>Se cuentan las piezas que dos sensores ven iguales y en la misma disposición: se necesitan {least}, {enough} es bueno.</translation>
    </message>
    <message>
        <source>1.  Ten or more pieces of different kinds and sizes, spread unevenly.</source>
        <translation>1.  Diez o más piezas de distintos tipos y tamaños, repartidas en forma desigual.</translation>
    </message>
    <message>
        <source>2.  Most of them where the views overlap.</source>
        <translation>2.  La mayoría donde las vistas se traslapan.</translation>
    </message>
    <message>
        <source>3.  Belt and fruit at rest, hands away.</source>
        <translation>3.  Cinta y fruta quietas, sin manos cerca.</translation>
    </message>
</context>
<context>
    <name>RefusedPanel</name>
    <message>
        <source>Redo: the sensors could not be placed, and nothing was changed</source>
        <translation>Rehacer: no se pudo ubicar los sensores, y nada cambió</translation>
    </message>
    <message>
        <source>What links the sensors</source>
        <translation>Lo que une a los sensores</translation>
    </message>
    <message>
        <source>And {count} more of the same.</source>
        <translation>Y {count} más de lo mismo.</translation>
    </message>
</context>
<context>
    <name>ResultPanel</name>
    <message>
        <source>What links the sensors, and how far that is off</source>
        <translation>Lo que une a los sensores, y cuánto yerra</translation>
    </message>
    <message>
        <source>What all sensors see, laid together</source>
        <translation>Lo que ven todos los sensores, junto</translation>
    </message>
    <message>
        <source>It appears here as soon as the sensors run.</source>
        <translation>Aparece aquí apenas funcionan los sensores.</translation>
    </message>
</context>
</TS>
